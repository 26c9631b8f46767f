#pragma once
// Images of any format that OpenImageIO reads.

#include <filesystem>
#include <string>
#include <variant>

#include "src/core/image.h"

namespace promenade::io {

/// What an image file holds. Floating-point files (.exr, .hdr, .pfm, float TIFF) hold linear radiance;
/// integer files (PNG, JPEG, TIFF, ... of 8 or 16 bits) hold code values for a display.
struct ImageFile {
  std::variant<RadianceMap, EncodedMap> colour;
  PixelFlow flowToNext;  ///< of Vector or forward channels (docs/formats.md), pixels to the next frame; empty
                         ///< if absent
  LuminanceMap
      luminance;  ///< channel Y of an .exr, as it stands there (cd/m2 with --absolute); empty if absent

  [[nodiscard]] Size size() const;
};

/// The first image of the file, over its display window (pixels outside the data window are 0). Channels R,
/// G, B or, where there are none, one grey channel (Y or the only one). Alpha is not used: colour comes out
/// as over black. An .exr may hold several layers, as prefixes of channels or as parts: `layer` names one
/// (its last component is enough where only one layer has that); empty: the one that is the whole picture.
/// Throws InputError if the file is missing, damaged, not an image, or has no colour, and if the layer is not
/// there or not the only one in question; the message says what was found.
[[nodiscard]] ImageFile readImage(const std::filesystem::path& file, const std::string& layer = {});

}  // namespace promenade::io
