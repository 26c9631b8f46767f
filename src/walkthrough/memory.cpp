#include <algorithm>
#include <cmath>

#include "src/walkthrough/walkthrough.h"

namespace promenade::walkthrough {

double memoryNeededBytes(const Settings& settings) {
  // A sample of a frame takes 45 bytes, one of a warped keyframe 29. At once: the keyframes of the current
  // line of splits and the inbetweens around the current frame, as many together as the spacing can be
  // halved; the middle's and an inbetween's visibility and two warps each, the blended frame and what of its
  // layers is interpolated. A display pixel takes at most 1 kB in the metric and the maps around it.
  const double samples =
      static_cast<double>(settings.size.area()) * settings.supersample * settings.supersample;
  const double halvings = std::ceil(std::log2(settings.keyframeSpacing));
  const double frames = settings.method == Method::kFull ? 1.0 : 3.0 + halvings;
  const double others = settings.method == Method::kFull ? 1.0 : 8.0;
  // The window of the filter, and its sums and what it moves (36 bytes a sample) beside it.
  const double filtered = settings.antialiasing ? settings.antialiasing->frames() + 1.0 : 0.0;
  const double metric = settings.method == Method::kFull ? 200.0 : 1000.0;
  const double walk =
      samples * 45.0 * (frames + others + filtered) + static_cast<double>(settings.size.area()) * metric;
  // Before it, placing keyframes: of a window of frames what they see (20 bytes a sample of 14400), and what
  // each finds in each (3600 bits and their vector).
  const double window = std::min(settings.keyframeSpacing, settings.frames.count() - 1) + 1.0;
  const double placing = settings.method == Method::kFull ? 0.0 : window * (20.0 * 14400.0 + window * 500.0);
  return std::max(walk, placing);
}

}  // namespace promenade::walkthrough
