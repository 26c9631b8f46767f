#pragma once
// Code values as one of 252 fixed colours, for GIF.

#include <array>
#include <cstdint>
#include <vector>

#include "src/core/image.h"

namespace promenade::io {

/// 0xAARRGGBB: 6 levels of red, 7 of green, 6 of blue, all opaque; the last four entries are unused black.
[[nodiscard]] std::array<std::uint32_t, 256> fixedPalette();

/// Palette indices, row after row. Ordered dither (Bayer 8x8) that stands still: one palette and one pattern
/// for the whole video, so that nothing flickers but what moves.
[[nodiscard]] std::vector<std::uint8_t> toPalette(const EncodedMap& image);

}  // namespace promenade::io
