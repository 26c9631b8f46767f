#include "ibr/reconstruction.h"

#include <glm/common.hpp>

namespace promenade::ibr {
namespace {

std::array<float, 4> cubicWeights(float f) {
  const float g = 1.0f - f;
  return {-0.5f * f * g * g, 1.0f + f * f * (1.5f * f - 2.5f), 1.0f + g * g * (1.5f * g - 2.5f),
          -0.5f * g * f * f};
}

Rgb catmullRom(const RadianceMap& map, const Between& at, const std::array<float, 4>& wx,
               const std::array<float, 4>& wy) {
  Rgb sum(0.0f);
  Rgb low = map(at.x, at.y);
  Rgb high = low;
  for (int j = 0; j < 4; ++j) {
    const Rgb* row = &map(at.x - 1, at.y - 1 + j);
    Rgb along(0.0f);
    for (int i = 0; i < 4; ++i) {
      along += wx[static_cast<std::size_t>(i)] * row[i];
      low = glm::min(low, row[i]);
      high = glm::max(high, row[i]);
    }
    sum += wy[static_cast<std::size_t>(j)] * along;
  }
  return glm::clamp(sum, low, high);
}

}  // namespace

std::array<float, 4> bilinearWeights(const Between& at) {
  const float u = at.fraction.x;
  const float v = at.fraction.y;
  return {(1.0f - u) * (1.0f - v), u * (1.0f - v), (1.0f - u) * v, u * v};
}

LayeredRadiance weightedMean(const Frame& source, const Between& at, const std::array<float, 4>& weights) {
  const float sum = weights[0] + weights[1] + weights[2] + weights[3];
  LayeredRadiance mean;
  for (int k = 0; k < 4; ++k) {
    const float weight = weights[static_cast<std::size_t>(k)];
    if (weight == 0.0f) continue;
    const int x = at.x + (k & 1);
    const int y = at.y + (k >> 1);
    if (weight == sum) return {source.diffuse(x, y), source.viewDependent(x, y)};
    mean.diffuse += weight / sum * source.diffuse(x, y);
    mean.viewDependent += weight / sum * source.viewDependent(x, y);
  }
  return mean;
}

LayeredRadiance catmullRom(const Frame& source, const Between& at) {
  const auto wx = cubicWeights(at.fraction.x);
  const auto wy = cubicWeights(at.fraction.y);
  return {catmullRom(source.diffuse, at, wx, wy), catmullRom(source.viewDependent, at, wx, wy)};
}

}  // namespace promenade::ibr
