#pragma once
// R'G'B' code values as 8-bit Y'CbCr 4:2:0. Our own, not swscale's: its results depend on the instruction
// set.

#include <cstdint>
#include <vector>

#include "src/core/image.h"

namespace promenade::io {

struct Yuv420 {
  Size size;                     ///< of luma; both even. Chroma has half of each
  std::vector<std::uint8_t> y;   ///< 16 to 235
  std::vector<std::uint8_t> cb;  ///< 16 to 240
  std::vector<std::uint8_t> cr;
};

/// The size rounded up to even numbers.
[[nodiscard]] Size evenSize(Size size);

/// ITU-R BT.709-6, 3.3 to 3.5 (derivation, 8-bit quantisation, limited range). Chroma is sited as MPEG-2 and
/// H.264 assume: with the left luma column, between the rows; filtered by (1 2 1)/4 across and (1 1)/2 down.
/// Odd sizes: the last column and row are repeated.
[[nodiscard]] Yuv420 toYuv420(const EncodedMap& image);

}  // namespace promenade::io
