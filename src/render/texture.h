#pragma once
// Filtered texture lookups. Mip pyramids are built once, in linear light (sRGB texels are decoded, averaged
// and encoded again), and stay at 8 bits a channel: 4/3 of the images in all, one pyramid for each encoding
// in which an image is read. Williams, Pyramidal Parametrics (SIGGRAPH 1983).

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "src/scene/scene.h"

namespace promenade::render {

/// The pyramids of every texture that the materials of a scene use. Level 0 is the scene's own image, not a
/// copy: the scene must outlive this object. Immutable; safe to use from any number of threads.
class TextureLibrary {
 public:
  explicit TextureLibrary(const Scene& scene);

  /// The texture's value at `uv` (the mesh's texture coordinates; the texture's transform is applied here),
  /// linear, averaged over about `footprintUv`: the width in uv units of what the sample stands for (0: no
  /// filtering). `texture` must be one of the scene's materials. Not-a-number or infinite coordinates read
  /// the texel at 0.
  [[nodiscard]] glm::vec4 sample(const Texture& texture, glm::vec2 uv, float footprintUv) const;

  /// Memory of the levels above 0, in bytes: what this object adds to the scene.
  [[nodiscard]] std::size_t bytes() const;

 private:
  using Texels = Image<std::array<std::uint8_t, 4>>;
  struct Pyramid {
    const Texels* base = nullptr;  ///< null: no material reads the image in this encoding
    std::vector<Texels> above;     ///< each half of the one before, rounded down, to 1x1
  };
  struct ImagePyramids {
    Pyramid srgb;
    Pyramid linear;
  };
  static Pyramid makePyramid(const Texels& base, TexelEncoding encoding);

  std::vector<ImagePyramids> images_;
};

}  // namespace promenade::render
