#include "src/render/material_textures.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

#include "src/render/surfaces.h"

namespace promenade::render {

FootprintAlongEdges alongEdges(const SurfacePoint& point, const Footprint& footprint) {
  const glm::vec3 normal = glm::cross(point.edge1, point.edge2);
  const float squared = glm::dot(normal, normal);
  if (!(squared > 0.0f)) return {};
  const auto solved = [&](const glm::vec3& axis) {
    return glm::vec2(glm::dot(glm::cross(axis, point.edge2), normal),
                     glm::dot(glm::cross(point.edge1, axis), normal)) /
           squared;
  };
  return {solved(footprint.major), solved(footprint.minor)};
}

TextureFootprints::TextureFootprints(const SurfacePoint& point, const FootprintAlongEdges& footprint,
                                     Detail detail) {
  const auto& [major, minor] = footprint;
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
    if (std::isfinite(longest)) footprints_[set] = {longAxis, shortAxis, detail};
  }
}

MaterialTextures::MaterialTextures(const Scene& scene) : library_(scene) {
  for (const TextureImage& image : scene.images) {
    const auto& counts = image.counts[3];
    const auto least = std::ranges::find_if(counts, [](std::uint64_t count) { return count > 0; });
    leastAlpha_.push_back(static_cast<float>(least - counts.begin()) / 255.0f);
  }
}

glm::vec4 MaterialTextures::at(const Texture& texture, const SurfacePoint& point,
                               const TextureFootprints& footprints) const {
  return library_.sample(texture, point.texCoord[texture.texCoord == 1 ? 1 : 0],
                         footprints.ofSet(texture.texCoord));
}

}  // namespace promenade::render
