#pragma once
// The metric's probabilities as a picture for people.

#include "src/core/image.h"

namespace promenade::app {

/// The reference in dim grey with the probability of detection over it in colour (transparent at 0), and a
/// legend of 24 rows below (narrow pictures get the colour bar without its numbers). `background`: luminance
/// of the reference, cd/m2.
[[nodiscard]] EncodedMap heatmap(const ProbabilityMap& probability, const LuminanceMap& background);

/// Black-blue, violet, orange, yellow-white for 0 to 1.
[[nodiscard]] Rgb heatColour(float probability);

}  // namespace promenade::app
