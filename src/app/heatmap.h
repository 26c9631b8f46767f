#pragma once
// A comparison as a picture for people: the two frames and, below them, where a viewer sees a difference and
// how large it is, each with a legend in words.

#include <string>

#include "src/core/image.h"

namespace promenade::app {

struct ComparedFrames {
  const EncodedMap& test;
  const EncodedMap& reference;
  const ProbabilityMap& probability;
  const JndMap& pooledJnd;  ///< 1 at threshold
  const Mask& excluded;     ///< nonzero where a pixel does not count; empty: all do
};

/// Above: test, reference. Below: the threshold map (the reference in grey, P in colours that change where P
/// exceeds 0.75) and the map of pooled JND. `title` is the first line. All have one size; frames below
/// 512 x 270 pixels are enlarged by a whole number, frames of more than 4096 pixels a side reduced by one.
[[nodiscard]] EncodedMap heatmap(const ComparedFrames& frames, const std::string& title);

/// Over a background of the given grey: through violet up to P = 0.75, from orange to yellow above.
[[nodiscard]] Rgb visibilityColour(float probability, float grey);

/// The threshold map's colour of a pixel: visibilityColour() over the darkened grey of `picture`.
[[nodiscard]] Rgb thresholdColour(float probability, const Rgb& picture);

/// Black, violet, orange, yellow for 0 to 8 just noticeable differences and more, in steps of log(1 + J).
[[nodiscard]] Rgb jndColour(float jnd);

/// The same over a background of the given grey, which shows through below 1 JND only.
[[nodiscard]] Rgb jndColourOver(float jnd, float grey);

/// A picture of luminance (cd/m2); `white`, > 0, becomes white.
[[nodiscard]] EncodedMap greyPicture(const LuminanceMap& luminance, float white);

}  // namespace promenade::app
