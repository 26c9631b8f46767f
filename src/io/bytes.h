#pragma once
// Code values in [0, 1] as the 8-bit values that files hold.

#include <cstdint>
#include <vector>

#include "src/core/image.h"

namespace promenade::io {

/// Rounded to nearest, no dithering; outside [0, 1] clamped, not-a-number becomes 0.
[[nodiscard]] inline std::uint8_t toByte(float code) {
  if (!(code > 0.0f)) return 0;
  return code < 1.0f ? static_cast<std::uint8_t>(code * 255.0f + 0.5f) : std::uint8_t{255};
}

/// R G B, row after row, no padding.
[[nodiscard]] std::vector<std::uint8_t> toRgbBytes(const EncodedMap& image);

}  // namespace promenade::io
