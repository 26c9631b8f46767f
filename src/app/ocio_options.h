#pragma once
// `--ocio` and what belongs to it, as typed.

#include <memory>
#include <string>

#include "src/core/colour_view.h"

namespace promenade::app {

struct OcioOptions {
  std::string config;   ///< file; empty: $OCIO
  std::string display;  ///< empty: the config's default
  std::string view;     ///< empty: the display's default
  std::string input;    ///< colour space of radiance; empty: found by its usual names

  [[nodiscard]] bool areGiven() const {
    return !(config.empty() && display.empty() && view.empty() && input.empty());
  }
};

/// Never null. Throws InputError where there is no config, and for one that cannot be used.
[[nodiscard]] std::shared_ptr<const ColourView> viewFrom(const OcioOptions& options);

}  // namespace promenade::app
