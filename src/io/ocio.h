#pragma once
// Views of OpenColorIO configs.

#include <string>

#include "src/core/colour_view.h"

namespace promenade::io {

struct ColourViewRequest {
  std::string config;        ///< file
  std::string display = {};  ///< empty: the config's default
  std::string view = {};     ///< empty: the display's default
  /// The config's name (colour space, role or alias) of linear Rec.709. Empty: the first that the config has
  /// of the usual names ("Linear Rec.709 (sRGB)", "lin_rec709" and others, "Utility - Linear - sRGB"); else
  /// through the role aces_interchange; else the role scene_linear, which is then taken to be Rec.709.
  std::string input = {};
};

/// Throws InputError that names the file, for an unknown display, view or colour space with those that there
/// are.
[[nodiscard]] ColourView openColourView(const ColourViewRequest& request);

}  // namespace promenade::io
