#include "src/render/normal_spread.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "src/render/material_textures.h"
#include "src/render/surfaces.h"

namespace promenade::render {
namespace {

constexpr float kMostAdded = 0.18f;

}  // namespace

float normalVariance(const SurfacePoint& point, const Footprint& footprint) {
  const auto squaredTurn = [&](const glm::vec3& axis) {
    const glm::vec2 inEdges = alongEdges(point, axis);
    const glm::vec3 change = inEdges.x * point.normalEdge1 + inEdges.y * point.normalEdge2;
    const glm::vec3 turn = change - glm::dot(change, point.normal) * point.normal;
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
