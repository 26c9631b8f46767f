#pragma once
// Texture lookups at a surface point.

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "src/render/detail.h"
#include "src/render/texture.h"
#include "src/scene/scene.h"

namespace promenade::render {

struct SurfacePoint;
struct Footprint;

/// The half axes of a footprint, in the plane of a triangle: s and t of s * edge1 + t * edge2. Whatever is
/// interpolated over the triangle changes along them by the same s and t of its own edges.
struct FootprintAlongEdges {
  glm::vec2 major{0.0f}, minor{0.0f};
};

/// On the point's triangle; 0 where that has no area.
[[nodiscard]] FootprintAlongEdges alongEdges(const SurfacePoint& point, const Footprint& footprint);

/// A footprint in the two sets of texture coordinates.
class TextureFootprints {
 public:
  TextureFootprints(const SurfacePoint& point, const FootprintAlongEdges& footprint, Detail detail);

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
