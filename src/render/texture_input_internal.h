#pragma once
// The images of a scene as OpenImageIO's texture system reads files: linear texels and the mip levels of one
// image, made when they are asked for. Level 0 is decoded; each other level is the mean of the one before,
// which the cache is asked for, so that an image is decoded once however many of its levels are wanted, and
// nothing but encoded bytes stays outside the cache. A level is one tile: PNG, JPEG and WebP can be decoded
// only whole. sRGB colours are kept as 16-bit linear numbers, because they are to be filtered in linear
// light; what is linear already keeps its 8 bits. Williams, Pyramidal Parametrics (SIGGRAPH 1983).

#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/ustring.h>

#include "src/scene/scene.h"

namespace promenade::render {

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
