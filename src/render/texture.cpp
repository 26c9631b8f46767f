#include "src/render/texture.h"

#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/texture.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "src/core/errors.h"
#include "src/render/texture_input_internal.h"

namespace promenade::render {
namespace {

/// Longest in relation to its width that a footprint is followed.
constexpr int kMostAnisotropy = 4;
/// Of a footprint, in widths of the image: more is its mean anyway.
constexpr float kWidest = 16.0f;
constexpr float kToNearestLevel = 0.70710678f;

OIIO::TextureOpt::Wrap toOiio(Wrap wrap) {
  switch (wrap) {
    case Wrap::kRepeat:
      return OIIO::TextureOpt::WrapPeriodic;
    case Wrap::kMirroredRepeat:
      return OIIO::TextureOpt::WrapMirror;
    case Wrap::kClampToEdge:
      break;
  }
  return OIIO::TextureOpt::WrapClamp;
}

/// The coordinate brought near 0, where its fraction is exact and no texel's index overflows.
float reduced(float t, Wrap wrap) {
  if (!std::isfinite(t)) return 0.0f;
  switch (wrap) {
    case Wrap::kRepeat:
      return t - std::floor(t);
    case Wrap::kMirroredRepeat:
      return t - 2.0f * std::floor(0.5f * t);
    case Wrap::kClampToEdge:
      break;
  }
  return std::clamp(t, 0.0f, 1.0f);
}

/// `axis`, of that length, as long as OpenImageIO must be told it is: it measures levels by the shorter side
/// of the image.
float widthForLevel(glm::vec2 axis, float length, Size size) {
  if (size.width == size.height) return length;
  const auto shorter = static_cast<float>(std::min(size.width, size.height));
  return glm::length(axis * glm::vec2(size.width, size.height)) / shorter;
}

}  // namespace

struct TextureLibrary::Cache {
  struct File : TextureFile {
    OIIO::TextureSystem::TextureHandle* handle = nullptr;  ///< null: no material reads it
  };
  struct Destroy {
    void operator()(OIIO::ImageCache* cache) const { OIIO::ImageCache::destroy(cache); }
    void operator()(OIIO::TextureSystem* system) const { OIIO::TextureSystem::destroy(system); }
  };
  /// What OpenImageIO needs to know of a thread. It keeps hold of the two tiles looked at last.
  using Lookups = std::vector<OIIO::TextureSystem::Perthread*>;

  explicit Cache(const Scene& scene);
  Cache(const Cache&) = delete;
  Cache& operator=(const Cache&) = delete;
  ~Cache();

  void addFile(const Scene& scene, const Texture& texture);
  [[nodiscard]] std::size_t indexOf(const Texture& texture) const {
    return 2 * static_cast<std::size_t>(texture.image) + (texture.encoding == TexelEncoding::kSrgb ? 0 : 1);
  }
  [[nodiscard]] OIIO::TextureSystem::Perthread* lookupsOf(std::size_t index);

  std::vector<File> files;  ///< two an image: sRGB, linear
  std::unique_ptr<OIIO::ImageCache, Destroy> images;
  std::unique_ptr<OIIO::TextureSystem, Destroy> system;
  bool isRoomy = false;  ///< the budget holds every texture whole
  tbb::enumerable_thread_specific<Lookups> lookups;
};

TextureLibrary::Cache::Cache(const Scene& scene)
    : files(2 * scene.images.size()),
      images(OIIO::ImageCache::create(false)),
      system(OIIO::TextureSystem::create(false, images.get())) {
  // Whatever OPENIMAGEIO_IMAGECACHE_OPTIONS in the environment says: a level is one tile, in its own format.
  images->attribute("autotile", 0);
  images->attribute("forcefloat", 0);
  images->attribute("max_memory_MB", static_cast<float>(scene.textureMegabytes));
  const auto add = [this, &scene](const std::optional<Texture>& texture) {
    if (texture) addFile(scene, *texture);
  };
  for (const Material& material : scene.materials) {
    add(material.baseColorTexture);
    add(material.metallicRoughnessTexture);
    add(material.normalTexture);
    add(material.emissionTexture);
    add(material.transmissionTexture);
    add(material.specularTexture);
    add(material.specularColorTexture);
    add(material.clearcoatTexture);
    add(material.clearcoatRoughnessTexture);
    add(material.clearcoatNormalTexture);
  }
  std::size_t whole = 0;
  for (const File& file : files) {
    if (file.handle != nullptr) whole += bytesOf(file);
  }
  isRoomy = whole <= static_cast<std::size_t>(scene.textureMegabytes) << 20;
}

TextureLibrary::Cache::~Cache() {
  for (const Lookups& ofThread : lookups) {
    for (OIIO::TextureSystem::Perthread* thread : ofThread) system->destroy_thread_info(thread);
  }
}

void TextureLibrary::Cache::addFile(const Scene& scene, const Texture& texture) {
  const auto image = static_cast<std::size_t>(texture.image);
  File& file = files[indexOf(texture)];
  if (file.handle != nullptr) return;
  file.image = &scene.images[image];
  file.encoding = texture.encoding;
  file.cache = images.get();
  file.name = OIIO::ustring("image " + std::to_string(image) +
                            (texture.encoding == TexelEncoding::kSrgb ? " sRGB" : " linear"));
  addToCache(file);
  file.handle = system->get_texture_handle(file.name);
}

OIIO::TextureSystem::Perthread* TextureLibrary::Cache::lookupsOf(std::size_t index) {
  // One for each texture finds the two levels in use without a search in the cache. But what it holds cannot
  // be dropped, so where memory is short a thread has only one.
  Lookups& ofThread = lookups.local();
  if (ofThread.empty()) ofThread.resize(isRoomy ? files.size() : 1);
  OIIO::TextureSystem::Perthread*& thread = ofThread[isRoomy ? index : 0];
  if (thread == nullptr) thread = system->create_thread_info();
  return thread;
}

TextureLibrary::TextureLibrary(const Scene& scene) : cache_(std::make_unique<Cache>(scene)) {}

TextureLibrary::~TextureLibrary() = default;

TextureUse TextureLibrary::use() const {
  TextureUse use;
  cache_->images->getattribute("stat:cache_memory_used", OIIO::TypeDesc::INT64, &use.bytes);
  const auto countOf = [this](const Cache::File& file, const char* what) {
    std::uint64_t count = 0;
    cache_->images->get_image_info(file.name, 0, 0, OIIO::ustring(what), OIIO::TypeDesc::INT64, &count);
    return count;
  };
  for (const Cache::File& file : cache_->files) {
    if (file.handle == nullptr) continue;
    use.levelsRead += countOf(file, "stat:tilesread");
    use.levelsReadAgain += countOf(file, "stat:redundant_tiles");
  }
  return use;
}

glm::vec4 TextureLibrary::sample(const Texture& texture, glm::vec2 uv,
                                 const TextureFootprint& footprint) const {
  const std::size_t index = cache_->indexOf(texture);
  const Cache::File& file = cache_->files[index];
  OIIO::TextureOpt options;
  options.swrap = toOiio(texture.wrapU);
  options.twrap = toOiio(texture.wrapV);
  options.mipmode = OIIO::TextureOpt::MipModeNoMIP;
  options.interpmode = OIIO::TextureOpt::InterpBilinear;
  options.anisotropic = kMostAnisotropy;

  const glm::mat2 linear(texture.transform);
  glm::vec2 longAxis = linear * footprint.longAxis;
  glm::vec2 shortAxis = linear * footprint.shortAxis;
  if (glm::length(shortAxis) > glm::length(longAxis)) std::swap(longAxis, shortAxis);
  // The ellipse is spread over twice the distance between two pixels along its long axis, which OpenImageIO
  // takes the derivatives to be; here they are what one sample of many stands for.
  longAxis *= 0.5f;
  const Size size = file.image->size;
  const float longLength = glm::length(longAxis);
  const float shortLength = glm::length(shortAxis);
  const float width = widthForLevel(shortAxis, shortLength, size);
  const auto shorter = static_cast<float>(std::min(size.width, size.height));
  if (texture.mipmapped && std::max(longLength, width) * shorter > 1.0f) {  // not if it is not a number
    if (footprint.detail == Detail::kBlurred) {
      // Of the two levels whose texels are just finer and just coarser than the width that is asked for,
      // OpenImageIO takes the second.
      options.mipmode = OIIO::TextureOpt::MipModeOneLevel;
      const float both = std::min(std::max(longLength, width), kWidest) * kToNearestLevel;
      longAxis = {both, 0.0f};
      shortAxis = {0.0f, both};
    } else if (longLength > 1.5f * width && std::isfinite(longLength)) {
      options.mipmode = OIIO::TextureOpt::MipModeAniso;
      const float longScale = std::min(1.0f, kWidest / longLength);
      const float shortScale = shortLength > 0.0f ? std::min(width, kWidest) / shortLength : 0.0f;
      longAxis *= longScale;
      shortAxis *= shortScale;
    } else {
      options.mipmode = OIIO::TextureOpt::MipModeTrilinear;
      const float both = std::min(std::max(longLength, width), kWidest);
      longAxis = {both, 0.0f};
      shortAxis = {0.0f, both};
    }
  } else if (texture.magnification == Filter::kNearest) {
    options.interpmode = OIIO::TextureOpt::InterpClosest;
  }

  const glm::vec3 at = texture.transform * glm::vec3(uv, 1.0f);
  alignas(16) std::array<float, 4> value{};
  if (!cache_->system->texture(file.handle, cache_->lookupsOf(index), options, reduced(at.x, texture.wrapU),
                               reduced(at.y, texture.wrapV), longAxis.x, longAxis.y, shortAxis.x, shortAxis.y,
                               4, value.data())) {
    throw CannotContinue(cache_->system->geterror());
  }
  return {value[0], value[1], value[2], value[3]};
}

}  // namespace promenade::render
