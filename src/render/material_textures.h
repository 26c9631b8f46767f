#pragma once
// Texture lookups at a surface point, anisotropic where the point is seen at a grazing angle.

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "src/render/texture.h"
#include "src/scene/scene.h"

namespace promenade::render {

struct SurfacePoint;
struct Footprint;

/// A footprint in the two sets of texture coordinates.
class TextureFootprints {
 public:
  TextureFootprints(const SurfacePoint& point, const Footprint& footprint);

  struct Taps {
    glm::vec2 step{0.0f};  ///< between taps, uv units
    float width = 0.0f;    ///< of one tap, uv units
    int count = 1;
  };
  [[nodiscard]] const Taps& ofSet(int set) const { return taps_[set == 1 ? 1 : 0]; }

 private:
  std::array<Taps, 2> taps_;
};

class MaterialTextures {
 public:
  explicit MaterialTextures(const Scene& scene);

  /// Averaged over the footprint: several lookups along its long axis (at most 8), each as wide as the short
  /// one.
  [[nodiscard]] glm::vec4 at(const Texture& texture, const SurfacePoint& point,
                             const TextureFootprints& footprints) const;
  /// Without filtering.
  [[nodiscard]] glm::vec4 finest(const Texture& texture, glm::vec2 uv) const {
    return library_.sample(texture, uv, 0.0f);
  }
  [[nodiscard]] float alpha(const Texture& texture, glm::vec2 uv) const { return finest(texture, uv).a; }
  /// Mean over about `widthUv` around `uv`.
  [[nodiscard]] glm::vec4 mean(const Texture& texture, glm::vec2 uv, float widthUv) const {
    return library_.sample(texture, uv, widthUv);
  }
  /// Least value of each channel over all texels, as encoded (only alpha is the same in every encoding).
  [[nodiscard]] glm::vec4 minimum(const Texture& texture) const {
    return minimum_[static_cast<std::size_t>(texture.image)];
  }

 private:
  TextureLibrary library_;
  std::vector<glm::vec4> minimum_;  // an image
};

}  // namespace promenade::render
