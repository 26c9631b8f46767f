#include "src/render/texture.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "src/core/errors.h"

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

TextureLibrary::TextureLibrary(const Scene& scene)
    : files_(2 * scene.images.size()),
      cache_(OIIO::ImageCache::create(false)),
      system_(OIIO::TextureSystem::create(false, cache_.get())) {
  cache_->attribute("max_memory_MB", static_cast<float>(scene.textureMegabytes));
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
  for (const File& file : files_) {
    if (file.handle != nullptr) whole += bytesOf(file);
  }
  isRoomy_ = whole <= static_cast<std::size_t>(scene.textureMegabytes) << 20;
}

TextureLibrary::~TextureLibrary() {
  for (const Lookups& lookups : lookups_) {
    for (OIIO::TextureSystem::Perthread* thread : lookups) system_->destroy_thread_info(thread);
  }
}

OIIO::TextureSystem::Perthread* TextureLibrary::lookupsOf(const File& file) const {
  // One for each texture finds the two levels in use without a search in the cache. But what it holds cannot
  // be dropped, so where memory is short a thread has only one.
  Lookups& lookups = lookups_.local();
  if (lookups.empty()) lookups.resize(isRoomy_ ? files_.size() : 1);
  OIIO::TextureSystem::Perthread*& thread =
      lookups[isRoomy_ ? static_cast<std::size_t>(&file - files_.data()) : 0];
  if (thread == nullptr) thread = system_->create_thread_info();
  return thread;
}

void TextureLibrary::addFile(const Scene& scene, const Texture& texture) {
  const auto index = static_cast<std::size_t>(texture.image);
  const bool isSrgb = texture.encoding == TexelEncoding::kSrgb;
  File& file = files_[2 * index + (isSrgb ? 0 : 1)];
  if (file.handle != nullptr) return;
  file.image = &scene.images[index];
  file.encoding = texture.encoding;
  file.cache = cache_.get();
  file.name = OIIO::ustring("image " + std::to_string(index) + (isSrgb ? " sRGB" : " linear"));
  addToCache(file);
  file.handle = system_->get_texture_handle(file.name);
}

const TextureLibrary::File& TextureLibrary::fileOf(const Texture& texture) const {
  const bool isSrgb = texture.encoding == TexelEncoding::kSrgb;
  return files_[2 * static_cast<std::size_t>(texture.image) + (isSrgb ? 0 : 1)];
}

TextureUse TextureLibrary::use() const {
  TextureUse use;
  cache_->getattribute("stat:cache_memory_used", OIIO::TypeDesc::INT64, &use.bytes);
  const auto countOf = [this](const File& file, const char* what) {
    std::uint64_t count = 0;
    cache_->get_image_info(file.name, 0, 0, OIIO::ustring(what), OIIO::TypeDesc::INT64, &count);
    return count;
  };
  for (const File& file : files_) {
    if (file.handle == nullptr) continue;
    use.levelsRead += countOf(file, "stat:tilesread");
    use.levelsReadAgain += countOf(file, "stat:redundant_tiles");
  }
  return use;
}

glm::vec4 TextureLibrary::sample(const Texture& texture, glm::vec2 uv,
                                 const TextureFootprint& footprint) const {
  const File& file = fileOf(texture);
  OIIO::TextureOpt options;
  options.swrap = toOiio(texture.wrapU);
  options.twrap = toOiio(texture.wrapV);
  options.mipmode = OIIO::TextureOpt::MipModeNoMIP;
  options.interpmode = OIIO::TextureOpt::InterpBilinear;
  options.anisotropic = kMostAnisotropy;

  // The ellipse is spread over twice the distance between two pixels along its long axis, which OpenImageIO
  // takes the derivatives to be; here they are what one sample of many stands for.
  const glm::mat2 linear(texture.transform);
  glm::vec2 longAxis = 0.5f * (linear * footprint.longAxis);
  glm::vec2 shortAxis = linear * footprint.shortAxis;
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
  if (!system_->texture(file.handle, lookupsOf(file), options, reduced(at.x, texture.wrapU),
                        reduced(at.y, texture.wrapV), longAxis.x, longAxis.y, shortAxis.x, shortAxis.y, 4,
                        value.data())) {
    throw CannotContinue(system_->geterror());
  }
  return {value[0], value[1], value[2], value[3]};
}

}  // namespace promenade::render
