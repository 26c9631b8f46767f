#include "src/core/tone_curves.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/mat3x3.hpp>

#include "src/core/display.h"

namespace promenade {
namespace {

constexpr double kSchlickWhite = 16.0;

// With v = g / white for middle grey g, p v / (p v - v + 1) = g gives p = g (1 - v) / (v (1 - g)).
constexpr double schlickSlope() {
  constexpr double kGrey = 0.18;
  constexpr double kValue = kGrey / kSchlickWhite;
  return kGrey * (1.0 - kValue) / (kValue * (1.0 - kGrey));
}

}  // namespace

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

Rgb agxCurve(const Rgb& exposed) {
  // Stops around 1 between which the curve runs from black to white.
  constexpr float kDarkest = -12.47393f;
  constexpr float kBrightest = 4.026069f;
  const glm::mat3 inset(0.842479062253094f, 0.0423282422610123f, 0.0423756549057051f, 0.0784335999999992f,
                        0.878468636469772f, 0.0784336f, 0.0792237451477643f, 0.0791661274605434f,
                        0.879142973793104f);
  const glm::mat3 outset(1.19687900512017f, -0.0528968517574562f, -0.0529716355144438f, -0.0980208811401368f,
                         1.15190312990417f, -0.0980434501171241f, -0.0990297440797205f, -0.0989611768448433f,
                         1.15107367264116f);
  const Rgb stops = glm::log2(glm::max(inset * exposed, Rgb(1e-10f)));
  const Rgb x = glm::clamp((stops - Rgb(kDarkest)) / (kBrightest - kDarkest), Rgb(0.0f), Rgb(1.0f));
  const Rgb x2 = x * x;
  const Rgb x4 = x2 * x2;
  const Rgb curve = 15.5f * x4 * x2 - 40.14f * x4 * x + 31.96f * x4 - 6.868f * x2 * x + 0.4298f * x2 +
                    0.1191f * x - Rgb(0.00232f);
  return glm::pow(glm::clamp(outset * curve, Rgb(0.0f), Rgb(1.0f)), Rgb(2.2f));
}

double schlickCurve(double value, double p) {
  return p * value / (p * value - value + 1.0);
}

Rgb schlick(const Rgb& exposed) {
  const double value = static_cast<double>(luminance(exposed)) / kSchlickWhite;
  return withLuminance(exposed, schlickCurve(std::min(value, 1.0), schlickSlope()));
}

Rgb withLuminance(const Rgb& colour, double wanted) {
  const auto has = static_cast<double>(luminance(colour));
  return has > 0.0 ? colour * static_cast<float>(wanted / has) : Rgb(0.0f);
}

}  // namespace promenade
