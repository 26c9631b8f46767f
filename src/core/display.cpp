#include "src/core/display.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace promenade {
namespace {

// An emissive display in a dark room shows true black; the eye's own noise keeps its logarithm finite.
constexpr double kDarkestLuminance = 1e-4;

float cleaned(float value) {
  return value > 0.0f ? std::min(value, 1e6f) : 0.0f;
}

// Khronos PBR Neutral tone mapper (Khronos Group, "Khronos PBR Neutral Tone Mapper" specification, 2024).
Rgb neutralCurve(Rgb color) {
  constexpr float kFresnel = 0.04f;
  constexpr float kStartCompression = 0.8f - kFresnel;
  constexpr float kDesaturation = 0.15f;

  const float smallest = std::min({color.r, color.g, color.b});
  const float offset =
      smallest < 2.0f * kFresnel ? smallest - smallest * smallest / (4.0f * kFresnel) : kFresnel;
  color -= Rgb(offset);

  const float peak = std::max({color.r, color.g, color.b});
  if (peak < kStartCompression) return color;
  const float d = 1.0f - kStartCompression;
  const float newPeak = 1.0f - d * d / (peak + d - kStartCompression);
  color *= newPeak / peak;
  const float g = 1.0f - 1.0f / (kDesaturation * (peak - newPeak) + 1.0f);
  return color * (1.0f - g) + Rgb(newPeak) * g;
}

float decode(float encoded, TransferFunction transfer) {
  const float v = std::clamp(encoded, 0.0f, 1.0f);
  switch (transfer) {
    case TransferFunction::kSrgb:
      return decodeSrgb(v);
    case TransferFunction::kGamma22:
      return std::pow(v, 2.2f);
    case TransferFunction::kLinear:
      return v;
  }
  return v;
}

}  // namespace

float luminance(const Rgb& linear) {
  return 0.2126f * linear.r + 0.7152f * linear.g + 0.0722f * linear.b;
}

float encodeSrgb(float linear) {
  const float v = std::abs(linear);
  const float e = v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f;
  return std::copysign(e, linear);
}

float decodeSrgb(float encoded) {
  const float v = std::abs(encoded);
  const float l = v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
  return std::copysign(l, encoded);
}

Rgb toneMap(const Rgb& radiance, const ToneMapping& tone) {
  const float scale = static_cast<float>(std::exp2(tone.exposureEv));
  Rgb color(cleaned(radiance.r * scale), cleaned(radiance.g * scale), cleaned(radiance.b * scale));
  if (tone.curve == ToneCurve::kNeutral) color = neutralCurve(color);
  return Rgb(std::clamp(color.r, 0.0f, 1.0f), std::clamp(color.g, 0.0f, 1.0f),
             std::clamp(color.b, 0.0f, 1.0f));
}

EncodedMap encodeForDisplay(const RadianceMap& radiance, const ToneMapping& tone) {
  EncodedMap encoded(radiance.size());
  const auto in = radiance.pixels();
  const auto out = encoded.pixels();
  for (std::size_t i = 0; i < in.size(); ++i) {
    const Rgb linear = toneMap(in[i], tone);
    out[i] = Rgb(encodeSrgb(linear.r), encodeSrgb(linear.g), encodeSrgb(linear.b));
  }
  return encoded;
}

double DisplayModel::pixelsPerDegree() const {
  const double diagonalPixels = std::hypot(resolution.width, resolution.height);
  const double pixelMetres = diagonalMetres / diagonalPixels;
  return viewingDistanceMetres * std::tan(std::numbers::pi / 180.0) / pixelMetres;
}

float DisplayModel::luminanceOf(const Rgb& encoded) const {
  const Rgb linear(decode(encoded.r, transfer), decode(encoded.g, transfer), decode(encoded.b, transfer));
  const double reflected = ambientIlluminance * screenReflectance / std::numbers::pi;
  const double emitted =
      blackLuminance + (peakLuminance - blackLuminance) * static_cast<double>(luminance(linear));
  return static_cast<float>(std::max(emitted + reflected, kDarkestLuminance));
}

LuminanceMap displayLuminance(const EncodedMap& encoded, const DisplayModel& display) {
  LuminanceMap luminances(encoded.size());
  const auto in = encoded.pixels();
  const auto out = luminances.pixels();
  for (std::size_t i = 0; i < in.size(); ++i) out[i] = display.luminanceOf(in[i]);
  return luminances;
}

}  // namespace promenade
