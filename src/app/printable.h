#pragma once

#include <string>
#include <string_view>

namespace promenade::app {

/// One line that cannot disturb a terminal: control characters become '?'. What files say ends up in
/// messages.
[[nodiscard]] inline std::string printable(std::string_view text) {
  std::string line(text);
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return line;
}

}  // namespace promenade::app
