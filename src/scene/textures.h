#pragma once
// Internal: a material's use of a texture: image, sampler, texture coordinates, KHR_texture_transform.

#include <optional>
#include <string>

#include "src/scene/images.h"
#include "src/scene/scene.h"
#include "src/scene/values.h"

namespace promenade::scene {

class TextureReader {
 public:
  TextureReader(const Gltf& gltf, ImageStore& images, Warnings& warnings)
      : gltf_(gltf), images_(images), warnings_(warnings) {}

  /// From tinygltf's TextureInfo, NormalTextureInfo: nothing if there is no texture.
  template <class Info>
  [[nodiscard]] std::optional<Texture> read(const Info& info, TexelEncoding encoding,
                                            const std::string& place) const {
    if (info.index < 0) {
      return std::nullopt;
    }
    return make(info.index, info.texCoord, extension(gltf_, info.extensions, "KHR_texture_transform", place),
                encoding, place);
  }
  /// From a textureInfo within an extension object.
  [[nodiscard]] std::optional<Texture> read(const Fields& info, TexelEncoding encoding) const;

 private:
  [[nodiscard]] std::optional<Texture> make(int index, int texCoord, const Fields& transform,
                                            TexelEncoding encoding, const std::string& place) const;

  const Gltf& gltf_;
  ImageStore& images_;
  Warnings& warnings_;
};

}  // namespace promenade::scene
