#include "src/render/environment.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "src/core/display.h"
#include "src/render/maths.h"

namespace promenade::render {
namespace {

Rgb usable(const Rgb& value) {
  const auto channel = [](float v) {
    if (std::isinf(v) && v > 0.0f) return 65504.0f;
    return v > 0.0f ? v : 0.0f;  // a comparison with not-a-number is false
  };
  return {channel(value.r), channel(value.g), channel(value.b)};
}

/// The four texels around an image position and their weights.
struct Corners {
  int x0, x1, y0, y1;
  float fx, fy;
};

Corners cornersAt(glm::vec2 uv, Size size) {
  const float x = uv.x * static_cast<float>(size.width) - 0.5f;
  const float y = uv.y * static_cast<float>(size.height) - 0.5f;
  const float floorX = std::floor(x);
  const float floorY = std::floor(y);
  const int column = static_cast<int>(floorX);
  const int row = static_cast<int>(floorY);
  return {column < 0 ? size.width - 1 : std::min(column, size.width - 1),
          column + 1 >= size.width ? 0 : column + 1,
          std::clamp(row, 0, size.height - 1),
          std::clamp(row + 1, 0, size.height - 1),
          x - floorX,
          y - floorY};
}

template <class T>
T bilinear(const Image<T>& image, glm::vec2 uv) {
  const Corners c = cornersAt(uv, image.size());
  const T top = image(c.x0, c.y0) * (1.0f - c.fx) + image(c.x1, c.y0) * c.fx;
  const T bottom = image(c.x0, c.y1) * (1.0f - c.fx) + image(c.x1, c.y1) * c.fx;
  return top * (1.0f - c.fy) + bottom * c.fy;
}

struct Choice {
  int index;
  float remainder;  ///< uniform in [0, 1) again
};

Choice choose(std::span<const float> cumulative, float u) {
  const auto found = std::upper_bound(cumulative.begin(), cumulative.end(), u);
  const auto index = std::min<std::ptrdiff_t>(found - cumulative.begin(), std::ssize(cumulative) - 1);
  const float below = index == 0 ? 0.0f : cumulative[static_cast<std::size_t>(index - 1)];
  const float width = cumulative[static_cast<std::size_t>(index)] - below;
  const float remainder = width > 0.0f ? (u - below) / width : 0.5f;
  return {static_cast<int>(index), std::clamp(remainder, 0.0f, 0x1.fffffep-1f)};
}

/// Density 1 - |x| on (-1, 1).
float sampleTent(float u) {
  return u < 0.5f ? std::sqrt(2.0f * u) - 1.0f : 1.0f - std::sqrt(2.0f * (1.0f - u));
}

/// Running sums divided by their total, in double so that dim texels after bright ones keep their share.
template <class WeightAt>
double accumulate(std::span<float> cumulative, WeightAt weightAt) {
  double sum = 0.0;
  for (std::size_t i = 0; i < cumulative.size(); ++i) sum += weightAt(i);
  double running = 0.0;
  for (std::size_t i = 0; i < cumulative.size(); ++i) {
    running += weightAt(i);
    cumulative[i] = sum > 0.0 ? static_cast<float>(running / sum) : 1.0f;
  }
  cumulative.back() = 1.0f;
  return sum;
}

}  // namespace

EnvironmentLight::EnvironmentLight(const Environment& environment)
    : radiance_(environment.radiance.size()),
      rotationTurns_(static_cast<float>(environment.rotationRadians / (2.0 * std::numbers::pi))),
      uniform_(environment.radiance.size() == Size{1, 1}) {
  const Size size = radiance_.size();
  std::transform(environment.radiance.pixels().begin(), environment.radiance.pixels().end(),
                 radiance_.pixels().begin(), [](const Rgb& value) { return usable(value); });

  Image<float> weights(size);
  glm::dvec3 sum(0.0);
  double solidAngle = 0.0;
  for (int y = 0; y < size.height; ++y) {
    const double sine = std::sin(std::numbers::pi * (y + 0.5) / size.height);
    for (int x = 0; x < size.width; ++x) {
      weights(x, y) = luminance(radiance_(x, y)) * static_cast<float>(sine);
      sum += glm::dvec3(radiance_(x, y)) * sine;
    }
    solidAngle += sine * size.width;
  }
  meanRadiance_ = Rgb(sum / solidAngle);
  if (uniform_) return;

  columnCumulative_ = Image<float>(size);
  std::vector<double> rowSums(static_cast<std::size_t>(size.height));
  for (int y = 0; y < size.height; ++y) {
    const auto row = weights.row(y);
    rowSums[static_cast<std::size_t>(y)] =
        accumulate(columnCumulative_.row(y), [row](std::size_t x) { return static_cast<double>(row[x]); });
  }
  rowCumulative_.resize(rowSums.size());
  const double total =
      accumulate(std::span(rowCumulative_), [&rowSums](std::size_t y) { return rowSums[y]; });
  if (!(total > 0.0)) return;  // black: nothing to sample
  const double scale = static_cast<double>(size.area()) / total;
  for (float& weight : weights.pixels()) weight = static_cast<float>(weight * scale);
  density_ = std::move(weights);
}

glm::vec2 EnvironmentLight::imagePosition(const glm::vec3& direction) const {
  float u = 0.5f + std::atan2(direction.x, -direction.z) / (2.0f * kPi) + rotationTurns_;
  u -= std::floor(u);
  return {u, std::acos(std::clamp(direction.y, -1.0f, 1.0f)) / kPi};
}

Rgb EnvironmentLight::radiance(const glm::vec3& direction) const {
  if (uniform_) return radiance_(0, 0);
  return bilinear(radiance_, imagePosition(direction));
}

float EnvironmentLight::densityAt(glm::vec2 uv) const {
  // dOmega = 2 pi^2 sin(theta) du dv.
  const float sine = std::max(std::sin(kPi * uv.y), 1e-6f);
  return bilinear(density_, uv) / (2.0f * kPi * kPi * sine);
}

float EnvironmentLight::uniformPdf() const {
  return luminance(meanRadiance_) > 0.0f ? 1.0f / (4.0f * kPi) : 0.0f;
}

EnvironmentSample EnvironmentLight::toward(const glm::vec3& direction) const {
  if (uniform_) return {direction, radiance_(0, 0), uniformPdf()};
  const glm::vec2 uv = imagePosition(direction);
  return {direction, bilinear(radiance_, uv), density_.empty() ? 0.0f : densityAt(uv)};
}

EnvironmentSample EnvironmentLight::sample(glm::vec2 u) const {
  if (uniform_) {
    if (!(luminance(meanRadiance_) > 0.0f)) return {};
    const float y = 1.0f - 2.0f * u.y;
    const float sine = std::sqrt(std::max(0.0f, 1.0f - y * y));
    const float phi = 2.0f * kPi * u.x;
    return {{sine * std::cos(phi), y, sine * std::sin(phi)}, radiance_(0, 0), uniformPdf()};
  }
  if (density_.empty()) return {};
  // A texel by its weight, then a point under the tent of bilinear interpolation around its centre. A tent
  // that sticks out over a pole is folded back there: just what clamped interpolation amounts to.
  const Choice row = choose(rowCumulative_, u.y);
  const Choice column = choose(columnCumulative_.row(row.index), u.x);
  const auto width = static_cast<float>(radiance_.width());
  const auto height = static_cast<float>(radiance_.height());
  glm::vec2 uv{(static_cast<float>(column.index) + 0.5f + sampleTent(column.remainder)) / width,
               std::abs((static_cast<float>(row.index) + 0.5f + sampleTent(row.remainder)) / height)};
  uv.x -= std::floor(uv.x);
  if (uv.y > 1.0f) uv.y = 2.0f - uv.y;

  const float theta = kPi * uv.y;
  const float phi = 2.0f * kPi * (uv.x - rotationTurns_ - 0.5f);
  const float sine = std::sin(theta);
  return {
      {sine * std::sin(phi), std::cos(theta), -sine * std::cos(phi)}, bilinear(radiance_, uv), densityAt(uv)};
}

}  // namespace promenade::render
