#pragma once
// The files of src/app/displays, as the build found them: the program needs no folder of data beside it.

#include <span>
#include <string_view>

namespace promenade::app {

struct DisplayPreset {
  std::string_view fileName;
  std::string_view json;  ///< docs/formats.md
};

/// The first is the default.
[[nodiscard]] std::span<const DisplayPreset> displayPresets();

}  // namespace promenade::app
