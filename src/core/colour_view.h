#pragma once
// What a colour management config makes of radiance: the view of a display.

#include <functional>
#include <string>

#include "src/core/image.h"

namespace promenade {

struct ColourView {
  std::string config;       ///< its file, an absolute path
  std::string display;      ///< as the config names it
  std::string view;         ///< of that display
  std::string input;        ///< what the config calls the colours that it is given
  std::string fingerprint;  ///< equal for equal transforms, wherever their files are
  /// Code values of the display for exposed radiance (linear Rec.709), black to white in [0, 1]; may be
  /// outside of that. Any number of threads may call it.
  std::function<Rgb(const Rgb&)> codes;
};

}  // namespace promenade
