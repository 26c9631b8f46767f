#pragma once
// The displays that are known by name, and displays described in files.

#include <string>

#include "src/core/display.h"

namespace promenade::app {

/// A preset's name, or a JSON file (docs/formats.md). Throws InputError that names the nearest preset.
[[nodiscard]] DisplayModel displayNamed(const std::string& nameOrFile);

/// Keys "name", "about" (for people), "resolution" [w, h], "diagonal" and "distance" (metres), "peak" and
/// "black" (cd/m2), "ambient" (lux), "reflectance", "transfer" ("srgb", "linear", "gamma2.2" or another
/// gamma), "primaries" (chromaticities of "red", "green", "blue", "white"), "signal" ("srgb", "native");
/// absent ones as in DisplayModel, which is the default preset. Unknown keys are errors.
[[nodiscard]] DisplayModel displayFromJson(const std::string& text, const std::string& fileName);

/// The presets' names, separated by '|'.
[[nodiscard]] std::string displayNames();

/// One line a preset, for `--display ?`.
[[nodiscard]] std::string displayList();

}  // namespace promenade::app
