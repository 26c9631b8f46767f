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

constexpr int kMostTaps = 8;
/// Of a footprint, in widths of the image: more is its mean anyway.
constexpr float kWidest = 16.0f;
constexpr float kToNearestLevel = 0.70710678f;

constexpr std::size_t kEncodings = 3;

const char* nameOf(TexelEncoding encoding) {
  switch (encoding) {
    case TexelEncoding::kSrgb:
      return " sRGB";
    case TexelEncoding::kNormal:
      return " normals";
    case TexelEncoding::kLinear:
      break;
  }
  return " linear";
}

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

/// The length of `axis` as OpenImageIO must be told it is: it measures levels by the shorter side of the
/// image.
float widthForLevel(glm::vec2 axis, Size size) {
  if (size.width == size.height) return glm::length(axis);
  const auto shorter = static_cast<float>(std::min(size.width, size.height));
  return glm::length(axis * glm::vec2(size.width, size.height)) / shorter;
}

/// Lookups side by side along the long axis of a footprint.
struct Taps {
  int count = 1;
  glm::vec2 step{0.0f};  ///< from one to the next
  float width = 0.0f;    ///< of each, as for OpenImageIO
  float longest = 0.0f;  ///< of the whole footprint, the same
};

/// Each is as wide as the short axis, or wider where that makes more than kMostTaps.
Taps tapsOf(glm::vec2 longAxis, glm::vec2 shortAxis, Size size) {
  if (glm::length(shortAxis) > glm::length(longAxis)) std::swap(longAxis, shortAxis);
  const float longest = glm::length(longAxis);
  const float ratio = longest / std::max(glm::length(shortAxis), longest / kMostTaps);
  Taps taps;
  if (std::isfinite(ratio)) taps.count = std::clamp(static_cast<int>(std::lround(ratio)), 1, kMostTaps);
  taps.step = longAxis / static_cast<float>(taps.count);
  taps.longest = widthForLevel(longAxis, size);
  taps.width = std::max(widthForLevel(shortAxis, size), widthForLevel(taps.step, size));
  return taps;
}

}  // namespace

struct TextureLibrary::Cache {
  struct File : TextureFile {
    OIIO::TextureSystem::TextureHandle* handle = nullptr;  ///< null: no material reads it
  };
  struct Destroy {
    void operator()(OIIO::ImageCache* cache) const { OIIO::ImageCache::destroy(cache); }
    /// OpenImageIO 2.4 tells the allocator a wrong size here: new_delete_type_mismatch=0 in
    /// CMakePresets.json.
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
    return kEncodings * static_cast<std::size_t>(texture.image) + static_cast<std::size_t>(texture.encoding);
  }
  [[nodiscard]] OIIO::TextureSystem::Perthread* lookupsOf(std::size_t index);

  std::vector<File> files;  ///< kEncodings an image
  std::unique_ptr<OIIO::ImageCache, Destroy> images;
  std::unique_ptr<OIIO::TextureSystem, Destroy> system;
  bool isRoomy = false;  ///< the budget holds every texture whole
  tbb::enumerable_thread_specific<Lookups> lookups;
};

TextureLibrary::Cache::Cache(const Scene& scene)
    : files(kEncodings * scene.images.size()),
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
  file.name = OIIO::ustring("image " + std::to_string(image) + nameOf(texture.encoding));
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
  OIIO::TextureSystem::Perthread* const thread = cache_->lookupsOf(index);
  OIIO::TextureOpt options;
  options.swrap = toOiio(texture.wrapU);
  options.twrap = toOiio(texture.wrapV);
  options.mipmode = OIIO::TextureOpt::MipModeNoMIP;
  options.interpmode = OIIO::TextureOpt::InterpBilinear;

  const glm::mat2 linear(texture.transform);
  const Size size = file.image->size;
  const Taps taps = tapsOf(linear * footprint.longAxis, linear * footprint.shortAxis, size);
  const auto shorter = static_cast<float>(std::min(size.width, size.height));
  float width = 0.0f;
  int count = 1;
  if (texture.mipmapped && taps.longest * shorter > 1.0f) {  // not if it is not a number
    if (footprint.detail == Detail::kBlurred) {
      // Of the two levels whose texels are just finer and just coarser than the width that is asked for,
      // OpenImageIO takes the second.
      options.mipmode = OIIO::TextureOpt::MipModeOneLevel;
      width = std::min(std::max(0.5f * taps.longest, taps.width), kWidest) * kToNearestLevel;
    } else {
      options.mipmode = OIIO::TextureOpt::MipModeTrilinear;
      width = std::min(taps.width, kWidest);
      count = taps.count;
    }
  } else if (texture.magnification == Filter::kNearest) {
    options.interpmode = OIIO::TextureOpt::InterpClosest;
  }

  const glm::vec3 middle = texture.transform * glm::vec3(uv, 1.0f);
  const auto tap = [&](int i) {
    const float offset = static_cast<float>(i) - 0.5f * static_cast<float>(count - 1);
    const glm::vec2 at = glm::vec2(middle) + offset * taps.step;
    alignas(16) std::array<float, 4> value{};
    if (!cache_->system->texture(file.handle, thread, options, reduced(at.x, texture.wrapU),
                                 reduced(at.y, texture.wrapV), width, 0.0f, 0.0f, width, 4, value.data())) {
      throw CannotContinue(cache_->system->geterror());
    }
    return glm::vec4(value[0], value[1], value[2], value[3]);
  };
  if (texture.encoding == TexelEncoding::kNormal) {
    MeanNormal mean;
    for (int i = 0; i < count; ++i) mean.add(1.0f / static_cast<float>(count), tap(i));
    return {mean.encoded(), mean.variance()};
  }
  glm::vec4 sum(0.0f);
  for (int i = 0; i < count; ++i) sum += tap(i);
  return sum / static_cast<float>(count);
}

}  // namespace promenade::render
