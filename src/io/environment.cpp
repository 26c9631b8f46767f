#include "src/io/environment.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "src/core/errors.h"
#include "src/io/image_file.h"

namespace promenade::io {

RadianceMap readEnvironment(const std::filesystem::path& file) {
  ImageFile image = readImage(file);
  auto* radiance = std::get_if<RadianceMap>(&image.colour);
  if (radiance == nullptr) {
    throw InputError(file.string(),
                     "expected linear floating-point radiance (.exr, .hdr), found an integer image");
  }
  for (Rgb& pixel : radiance->pixels()) {
    for (int i = 0; i < 3; ++i) pixel[i] = pixel[i] > 0.0f ? std::min(pixel[i], 65504.0f) : 0.0f;
  }
  return std::move(*radiance);
}

}  // namespace promenade::io
