#pragma once
// The images of a scene as OpenImageIO's texture system reads files: linear texels and the mip levels of one
// image, made when they are asked for. Level 0 is decoded; each other level is the mean of the one before,
// which the cache is asked for, so that an image is decoded once however many of its levels are wanted, and
// nothing but encoded bytes stays outside the cache. A level is one tile: PNG, JPEG and WebP can be decoded
// only whole. sRGB colours are kept as 16-bit linear numbers, because they are to be filtered in linear
// light; what is linear already keeps its 8 bits. Of normals the alpha channel, which has no meaning there,
// is the deviation of those that a texel of the level stands for: a mean does not tell bumps from a flat
// surface, and the surface's reflections do. Williams, Pyramidal Parametrics (SIGGRAPH 1983); Toksvig,
// Mipmapping Normal Maps (2005).

#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/ustring.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "src/scene/scene.h"

namespace promenade::render {

/// The mean of normals that vary: texels of TexelEncoding::kNormal, in [0, 1].
class MeanNormal {
 public:
  void add(float weight, const glm::vec4& texel) {
    const glm::vec3 n = 2.0f * glm::vec3(texel) - 1.0f;
    sum_ += weight * n;
    squares_ += weight * (glm::dot(n, n) + texel.a * texel.a);
  }
  [[nodiscard]] glm::vec3 encoded() const { return 0.5f * (sum_ + 1.0f); }
  /// About the mean, all directions together; in [0, 1] for unit vectors.
  [[nodiscard]] float variance() const { return std::max(squares_ - glm::dot(sum_, sum_), 0.0f); }

 private:
  glm::vec3 sum_{0.0f};  // weights sum to 1
  float squares_ = 0.0f;
};

/// One image in one encoding.
struct TextureFile {
  const TextureImage* image = nullptr;
  TexelEncoding encoding = TexelEncoding::kLinear;
  OIIO::ImageCache* cache = nullptr;
  OIIO::ustring name;  ///< in the cache
};

/// Makes `file` known to its cache under its name; it must stay where it is as long as the cache lives.
void addToCache(const TextureFile& file);

/// Of level `level`: each side halved so often, rounded down, at least 1.
[[nodiscard]] Size sizeOfLevel(Size size, int level);
/// Memory of all levels together.
[[nodiscard]] std::size_t bytesOf(const TextureFile& file);

}  // namespace promenade::render
