#pragma once
// A frame as a viewer gets it.

#include "src/walkthrough/walkthrough.h"

namespace promenade::walkthrough {

/// A picture of the walk's frame `index` (settings.size pixels) on the display, cd/m2.
[[nodiscard]] LuminanceMap seenOnDisplay(const RadianceMap& picture, int index, const Settings& settings);

/// The same of its samples, resolved to settings.size pixels.
[[nodiscard]] LuminanceMap seenOnDisplay(const Frame& samples, int index, const Settings& settings);

/// The same of one that is compared with others of the same frame: with surroundings (chiu.h) that are
/// theirs, too.
[[nodiscard]] LuminanceMap seenOnDisplay(const Frame& samples, int index, const Settings& settings,
                                         const Surroundings& surroundings);

[[nodiscard]] LuminanceMap seenOnDisplay(const RadianceMap& picture, int index, const Settings& settings,
                                         const Surroundings& surroundings);

/// Those of the picture, or of the samples' picture.
[[nodiscard]] Surroundings surroundingsOf(const RadianceMap& picture, int index, const Settings& settings);
[[nodiscard]] Surroundings surroundingsOf(const Frame& samples, int index, const Settings& settings);

}  // namespace promenade::walkthrough
