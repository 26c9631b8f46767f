#include "src/scene/textures.h"

#include <cmath>

namespace promenade::scene {
namespace {

Wrap toWrap(const Gltf& gltf, int mode, const std::string& place) {
  switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
      return Wrap::kRepeat;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return Wrap::kMirroredRepeat;
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return Wrap::kClampToEdge;
    default:
      gltf.fail(place, "found " + std::to_string(mode) + ", which is no wrap mode of glTF");
  }
}

void readSampler(const Gltf& gltf, int index, Texture& texture, const std::string& place) {
  if (index < 0) {
    return;
  }
  gltf.checkIndex(index, gltf.model.samplers.size(), place, "sampler");
  const tinygltf::Sampler& sampler = gltf.model.samplers[static_cast<std::size_t>(index)];
  const std::string where = at("samplers", static_cast<std::size_t>(index));
  texture.wrapU = toWrap(gltf, sampler.wrapS, where + ".wrapS");
  texture.wrapV = toWrap(gltf, sampler.wrapT, where + ".wrapT");
  texture.magnification =
      sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST ? Filter::kNearest : Filter::kLinear;
  texture.mipmapped = sampler.minFilter != TINYGLTF_TEXTURE_FILTER_NEAREST &&
                      sampler.minFilter != TINYGLTF_TEXTURE_FILTER_LINEAR;
}

/// KHR_texture_transform: scale, then rotation (counter-clockwise as the image is seen, v pointing down),
/// then offset.
glm::mat3 toMatrix(const Fields& transform) {
  const glm::vec2 offset = transform.vector("offset", glm::vec2(0.0f));
  const glm::vec2 scale = transform.vector("scale", glm::vec2(1.0f));
  const float rotation = transform.number("rotation", 0.0f);
  const float c = std::cos(rotation);
  const float s = std::sin(rotation);
  // Columns.
  return glm::mat3(glm::vec3(c * scale.x, -s * scale.x, 0.0f), glm::vec3(s * scale.y, c * scale.y, 0.0f),
                   glm::vec3(offset, 1.0f));
}

}  // namespace

std::optional<Texture> TextureReader::read(const Fields& info, TexelEncoding encoding) const {
  if (!info) {
    return std::nullopt;
  }
  const Fields transform = info.object("extensions").object("KHR_texture_transform");
  return make(info.index("index", -1), info.index("texCoord", 0), transform, encoding, info.place());
}

std::optional<Texture> TextureReader::make(int index, int texCoord, const Fields& transform,
                                           TexelEncoding encoding, const std::string& place) const {
  gltf_.checkIndex(index, gltf_.model.textures.size(), place + ".index", "texture");
  const tinygltf::Texture& source = gltf_.model.textures[static_cast<std::size_t>(index)];
  const std::string where = at("textures", static_cast<std::size_t>(index));
  Texture texture;
  texture.encoding = encoding;
  readSampler(gltf_, source.sampler, texture, where + ".sampler");
  texture.texCoord = texCoord;
  if (transform) {
    texture.texCoord = transform.index("texCoord", texCoord);
    texture.transform = toMatrix(transform);
  }
  if (texture.texCoord > 1) {
    warnings_.add(place +
                  ": only the texture coordinate sets 0 and 1 are supported; the texture is left out");
    return std::nullopt;
  }
  const Fields webp = extension(gltf_, source.extensions, "EXT_texture_webp", where);
  const int image = webp ? webp.index("source", source.source) : source.source;
  if (image < 0) {
    warnings_.add(where + ": has no image in a supported format; it is left out");
    return std::nullopt;
  }
  texture.image = images_.use(image, where + ".source");
  return texture;
}

}  // namespace promenade::scene
