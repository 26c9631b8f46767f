#pragma once
// Lat-long environment maps.

#include <filesystem>

#include "src/core/image.h"

namespace promenade::io {

/// Linear radiance over all directions from a floating-point image (.exr, .hdr): rows from the zenith down.
/// Radiance that is negative or not a number becomes 0 and what is above 65504 (the sun in half float, and
/// infinity) becomes 65504: one such pixel would otherwise take every light sample. Throws InputError if the
/// file cannot be read or is an integer (display-encoded) image.
[[nodiscard]] RadianceMap readEnvironment(const std::filesystem::path& file);

}  // namespace promenade::io
