#pragma once
// Images of any format that OpenImageIO reads.

#include <filesystem>
#include <variant>

#include "src/core/image.h"

namespace promenade::io {

/// What an image file holds. Floating-point files (.exr, .hdr, .pfm, float TIFF) hold linear radiance;
/// integer files (PNG, JPEG, TIFF, ... of 8 or 16 bits) hold code values for a display.
struct ImageFile {
  std::variant<RadianceMap, EncodedMap> colour;
  PixelFlow flowToNext;  ///< channels Vector.X, Vector.Y, pixels to the next frame; empty if absent
  LuminanceMap
      luminance;  ///< channel Y of an .exr, as it stands there (cd/m2 with --absolute); empty if absent

  [[nodiscard]] Size size() const;
};

/// The first image of the file, over its display window (pixels outside the data window are 0). Channels R,
/// G, B or, where there are none, one grey channel (Y or the only one). Alpha is not used: colour comes out
/// as over black. Throws InputError if the file is missing, damaged, not an image, or has no colour; the
/// message says what was found.
[[nodiscard]] ImageFile readImage(const std::filesystem::path& file);

}  // namespace promenade::io
