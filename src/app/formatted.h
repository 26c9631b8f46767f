#pragma once
// Text by printf's rules.

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>

namespace promenade::app {

/// At most 511 characters; what is longer is cut.
[[nodiscard]] std::string formatted(const char* format, auto... values) {
  char buffer[512];
  const int length = std::snprintf(buffer, sizeof(buffer), format, values...);
  return std::string(buffer, static_cast<std::size_t>(std::clamp(length, 0, 511)));
}

}  // namespace promenade::app
