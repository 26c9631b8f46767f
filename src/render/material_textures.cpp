#include "src/render/material_textures.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "src/render/surfaces.h"

namespace promenade::render {
namespace {

constexpr int kMostTaps = 8;

}  // namespace

TextureFootprints::TextureFootprints(const SurfacePoint& point, const Footprint& footprint) {
  const glm::vec3 normal = glm::cross(point.edge1, point.edge2);
  const float squared = glm::dot(normal, normal);
  if (!(squared > 0.0f)) return;
  // An axis in the plane of the triangle is s * edge1 + t * edge2; the texture coordinates move by the same s
  // and t.
  const auto solve = [&](const glm::vec3& axis) {
    return glm::vec2(glm::dot(glm::cross(axis, point.edge2), normal),
                     glm::dot(glm::cross(point.edge1, axis), normal)) /
           squared;
  };
  const glm::vec2 major = solve(footprint.major);
  const glm::vec2 minor = solve(footprint.minor);
  for (std::size_t set = 0; set < 2; ++set) {
    const glm::vec2& e1 = point.texCoordEdge1[set];
    const glm::vec2& e2 = point.texCoordEdge2[set];
    glm::vec2 longAxis = major.x * e1 + major.y * e2;
    glm::vec2 shortAxis = minor.x * e1 + minor.y * e2;
    float longest = glm::length(longAxis);
    float shortest = glm::length(shortAxis);
    if (shortest > longest) {
      std::swap(longAxis, shortAxis);
      std::swap(longest, shortest);
    }
    Taps& taps = taps_[set];
    if (!std::isfinite(longest) || longest <= 0.0f) continue;
    const float ratio = longest / std::max(shortest, longest / static_cast<float>(kMostTaps));
    taps.count = std::clamp(static_cast<int>(std::lround(ratio)), 1, kMostTaps);
    taps.step = longAxis / static_cast<float>(taps.count);
    taps.width = std::max(shortest, longest / static_cast<float>(taps.count));
  }
}

MaterialTextures::MaterialTextures(const Scene& scene)
    : library_(scene), minimum_(scene.images.size(), glm::vec4(1.0f)) {
  for (std::size_t i = 0; i < scene.images.size(); ++i) {
    std::array<std::uint8_t, 4> least{255, 255, 255, 255};
    for (const auto& texel : scene.images[i].texels.pixels()) {
      for (std::size_t c = 0; c < 4; ++c) least[c] = std::min(least[c], texel[c]);
    }
    minimum_[i] = glm::vec4(least[0], least[1], least[2], least[3]) / 255.0f;
  }
}

glm::vec4 MaterialTextures::at(const Texture& texture, const SurfacePoint& point,
                               const TextureFootprints& footprints) const {
  const TextureFootprints::Taps& taps = footprints.ofSet(texture.texCoord);
  const glm::vec2 uv = point.texCoord[texture.texCoord == 1 ? 1 : 0];
  if (taps.count == 1) return library_.sample(texture, uv, taps.width);
  glm::vec4 sum(0.0f);
  for (int i = 0; i < taps.count; ++i) {
    const float offset = static_cast<float>(i) - 0.5f * static_cast<float>(taps.count - 1);
    sum += library_.sample(texture, uv + offset * taps.step, taps.width);
  }
  return sum / static_cast<float>(taps.count);
}

}  // namespace promenade::render
