#include "src/core/display.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <numbers>

namespace promenade {
namespace {

// An emissive display in a dark room shows true black; the eye's own noise keeps its logarithm finite.
constexpr double kDarkestLuminance = 1e-4;

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

double DisplayModel::pixelsPerDegree() const {
  const double diagonalPixels = std::hypot(resolution.width, resolution.height);
  const double pixelMetres = diagonalMetres / diagonalPixels;
  return viewingDistanceMetres * std::tan(std::numbers::pi / 180.0) / pixelMetres;
}

float DisplayModel::decoded(float code) const {
  const float v = std::clamp(code, 0.0f, 1.0f);
  switch (transfer) {
    case TransferFunction::kSrgb:
      return decodeSrgb(v);
    case TransferFunction::kGamma:
      return std::pow(v, static_cast<float>(gamma));
    case TransferFunction::kLinear:
      return v;
  }
  return v;
}

float DisplayModel::encoded(float drive) const {
  const float v = std::clamp(drive, 0.0f, 1.0f);
  switch (transfer) {
    case TransferFunction::kSrgb:
      return encodeSrgb(v);
    case TransferFunction::kGamma:
      return std::pow(v, static_cast<float>(1.0 / gamma));
    case TransferFunction::kLinear:
      return v;
  }
  return v;
}

double DisplayModel::reflectedLuminance() const {
  return ambientIlluminance * screenReflectance / std::numbers::pi;
}

Rgb DisplayModel::luminanceWeights() const {
  // As rounded in BT.709, so that its luminance() is the same to the last bit.
  if (primaries == Primaries{}) return {0.2126f, 0.7152f, 0.0722f};
  return Rgb(glm::row(xyzFromRgb(primaries), 1));
}

float DisplayModel::luminanceOf(const Rgb& encoded) const {
  return luminanceOf(encoded, luminanceWeights());
}

float DisplayModel::luminanceOf(const Rgb& encoded, const Rgb& weights) const {
  const Rgb linear(decoded(encoded.r), decoded(encoded.g), decoded(encoded.b));
  const float y = weights.r * linear.r + weights.g * linear.g + weights.b * linear.b;
  const double emitted = blackLuminance + (peakLuminance - blackLuminance) * static_cast<double>(y);
  return static_cast<float>(std::max(emitted + reflectedLuminance(), kDarkestLuminance));
}

LuminanceMap displayLuminance(const EncodedMap& encoded, const DisplayModel& display) {
  LuminanceMap luminances(encoded.size());
  const Rgb weights = display.luminanceWeights();
  const auto in = encoded.pixels();
  const auto out = luminances.pixels();
  for (std::size_t i = 0; i < in.size(); ++i) out[i] = display.luminanceOf(in[i], weights);
  return luminances;
}

}  // namespace promenade
