#pragma once
// Filtered texture lookups, by OpenImageIO's texture system: mip-mapped, anisotropic, within a budget of
// memory.

#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/texture.h>
#include <tbb/enumerable_thread_specific.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

#include "src/core/renderer.h"
#include "src/render/detail.h"
#include "src/render/texture_input.h"
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
  /// linear, averaged over the footprint. `texture` must be one of the scene's materials. Not-a-number or
  /// infinite coordinates read the texel at 0. Throws CannotContinue if an image cannot be decoded again
  /// (memory).
  [[nodiscard]] glm::vec4 sample(const Texture& texture, glm::vec2 uv,
                                 const TextureFootprint& footprint) const;

  [[nodiscard]] TextureUse use() const;

 private:
  struct File : TextureFile {
    OIIO::TextureSystem::TextureHandle* handle = nullptr;  ///< null: no material reads it
  };
  struct Destroy {
    void operator()(OIIO::ImageCache* cache) const { OIIO::ImageCache::destroy(cache); }
    void operator()(OIIO::TextureSystem* system) const { OIIO::TextureSystem::destroy(system); }
  };
  /// What OpenImageIO needs to know of a thread. It keeps hold of the two tiles looked at last.
  using Lookups = std::vector<OIIO::TextureSystem::Perthread*>;
  [[nodiscard]] OIIO::TextureSystem::Perthread* lookupsOf(const File& file) const;
  void addFile(const Scene& scene, const Texture& texture);
  [[nodiscard]] const File& fileOf(const Texture& texture) const;

  std::vector<File> files_;  // two an image: sRGB, linear
  std::unique_ptr<OIIO::ImageCache, Destroy> cache_;
  std::unique_ptr<OIIO::TextureSystem, Destroy> system_;
  bool isRoomy_ = false;  ///< the budget holds every texture whole
  mutable tbb::enumerable_thread_specific<Lookups> lookups_;
};

}  // namespace promenade::render
