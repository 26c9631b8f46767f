#pragma once
// Filtered texture lookups, by OpenImageIO's texture system: mip-mapped, anisotropic, within a budget of
// memory.

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <memory>

#include "src/core/renderer.h"
#include "src/render/detail.h"
#include "src/scene/scene.h"

namespace promenade::render {

/// What a lookup stands for: two axes that span it, in the mesh's texture coordinates. The mean is over about
/// a parallelogram with these sides. {0, 0}: no filtering.
struct TextureFootprint {
  glm::vec2 longAxis{0.0f};
  glm::vec2 shortAxis{0.0f};  ///< not longer
  Detail detail = Detail::kFull;

  [[nodiscard]] static TextureFootprint round(float width) { return {{width, 0.0f}, {0.0f, width}}; }
};

/// The textures of a scene's materials. Safe to use from any number of threads; what a lookup gives depends
/// neither on them nor on the budget.
class TextureLibrary {
 public:
  /// Decoded texels are kept until they take scene.textureMegabytes (at least 10); then those that were not
  /// used lately are dropped, to be decoded again when they are needed. What a single lookup needs is always
  /// there: the largest level of one image for each thread. `scene` must outlive this object.
  explicit TextureLibrary(const Scene& scene);
  TextureLibrary(const TextureLibrary&) = delete;
  TextureLibrary& operator=(const TextureLibrary&) = delete;
  ~TextureLibrary();

  /// The texture's value at `uv` (the mesh's texture coordinates; the texture's transform is applied here),
  /// linear, averaged over the footprint. Of TexelEncoding::kNormal: the mean vector m, as (m + 1) / 2, and
  /// the variance of the vectors, all directions together, in place of alpha. `texture` must be one of the
  /// scene's materials. Not-a-number or infinite coordinates read the texel at 0. Throws CannotContinue if an
  /// image cannot be decoded again (memory).
  [[nodiscard]] glm::vec4 sample(const Texture& texture, glm::vec2 uv,
                                 const TextureFootprint& footprint) const;

  [[nodiscard]] TextureUse use() const;

 private:
  struct Cache;  // OpenImageIO's
  std::unique_ptr<Cache> cache_;
};

}  // namespace promenade::render
