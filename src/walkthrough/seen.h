#pragma once
// A frame as a viewer gets it.

#include "src/walkthrough/walkthrough.h"

namespace promenade::walkthrough {

/// The light of the samples on the display: resolved, tone mapped, cd/m2. settings.size pixels.
[[nodiscard]] LuminanceMap seenOnDisplay(const Frame& samples, const Settings& settings);

}  // namespace promenade::walkthrough
