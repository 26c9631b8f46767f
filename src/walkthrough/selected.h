#pragma once
// What a mask selects.

#include <algorithm>
#include <cstdint>

#include "src/core/image.h"

namespace promenade::walkthrough {

[[nodiscard]] inline bool isAnySelected(const Mask& mask) {
  return std::ranges::any_of(mask.pixels(), [](std::uint8_t v) { return v != 0; });
}

[[nodiscard]] inline std::uint64_t countSelected(const Mask& mask) {
  return static_cast<std::uint64_t>(
      std::ranges::count_if(mask.pixels(), [](std::uint8_t v) { return v != 0; }));
}

/// Of all.
[[nodiscard]] inline double percentSelected(const Mask& mask) {
  return 100.0 * static_cast<double>(countSelected(mask)) / static_cast<double>(mask.size().area());
}

}  // namespace promenade::walkthrough
