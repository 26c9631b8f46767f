#include "src/render/normal_spread.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "src/render/bsdf.h"
#include "src/render/material_textures.h"

namespace promenade::render {
namespace {

constexpr float kMostAdded = 0.18f;

}  // namespace

float normalVariance(const glm::vec3& normal, const NormalChange& change,
                     const FootprintAlongEdges& footprint) {
  const auto squaredTurn = [&](const glm::vec2& axis) {
    const glm::vec3 changed = axis.x * change.edge1 + axis.y * change.edge2;
    const glm::vec3 turn = changed - glm::dot(changed, normal) * normal;
    return glm::dot(turn, turn);
  };
  const float variance = (squaredTurn(footprint.major) + squaredTurn(footprint.minor)) / 12.0f;
  return std::isfinite(variance) ? variance : 0.0f;
}

float broadenedRoughness(float roughness, float variance) {
  const float alpha = roughness * roughness;
  const float alphaSquared = alpha * alpha + std::min(variance, kMostAdded);
  return std::min(std::sqrt(std::sqrt(alphaSquared)), 1.0f);
}

void broaden(BsdfParameters& bsdf, float variance, float clearcoatVariance) {
  if (bsdf.transmission > 0.0f) return;
  if (variance > 0.0f) bsdf.roughness = broadenedRoughness(bsdf.roughness, variance);
  if (clearcoatVariance > 0.0f) {
    bsdf.clearcoatRoughness = broadenedRoughness(bsdf.clearcoatRoughness, clearcoatVariance);
  }
}

}  // namespace promenade::render
