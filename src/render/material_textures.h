#pragma once
// Texture lookups at a surface point.

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "src/render/texture.h"
#include "src/scene/scene.h"

namespace promenade::render {

struct SurfacePoint;
struct Footprint;

/// s and t by which an axis in the plane of the point's triangle is s * edge1 + t * edge2: whatever is
/// interpolated over the triangle changes by the same s and t of its own edges. 0 where the triangle has no
/// area.
[[nodiscard]] glm::vec2 alongEdges(const SurfacePoint& point, const glm::vec3& axis);

/// A footprint in the two sets of texture coordinates.
class TextureFootprints {
 public:
  TextureFootprints(const SurfacePoint& point, const Footprint& footprint);

  [[nodiscard]] const TextureFootprint& ofSet(int set) const { return footprints_[set == 1 ? 1 : 0]; }

 private:
  std::array<TextureFootprint, 2> footprints_;
};

class MaterialTextures {
 public:
  explicit MaterialTextures(const Scene& scene);

  /// Averaged over the footprint.
  [[nodiscard]] glm::vec4 at(const Texture& texture, const SurfacePoint& point,
                             const TextureFootprints& footprints) const;
  /// Without filtering.
  [[nodiscard]] glm::vec4 finest(const Texture& texture, glm::vec2 uv) const {
    return library_.sample(texture, uv, {});
  }
  [[nodiscard]] float alpha(const Texture& texture, glm::vec2 uv) const { return finest(texture, uv).a; }
  /// Mean over about `widthUv` around `uv`.
  [[nodiscard]] glm::vec4 mean(const Texture& texture, glm::vec2 uv, float widthUv) const {
    return library_.sample(texture, uv, TextureFootprint::round(widthUv));
  }
  [[nodiscard]] TextureUse use() const { return library_.use(); }
  /// Least alpha of all texels.
  [[nodiscard]] float leastAlpha(const Texture& texture) const {
    return leastAlpha_[static_cast<std::size_t>(texture.image)];
  }

 private:
  TextureLibrary library_;
  std::vector<float> leastAlpha_;  // an image
};

}  // namespace promenade::render
