#include "paths/limits.h"

#include <algorithm>
#include <cmath>

#include "paths/text.h"
#include "src/core/errors.h"

namespace promenade::paths {

int frameCountOf(double durationSeconds, double framesPerSecond, const std::string& where) {
  const double frames = std::round(durationSeconds * framesPerSecond);
  if (!(frames <= kMaxFrames)) {
    throw InputError(where, "expected at most " + number(kMaxFrames) + " frames, found " + number(frames) +
                                " (" + number(durationSeconds) + " s at " + number(framesPerSecond) +
                                " frames/s)");
  }
  return std::max(1, static_cast<int>(frames));
}

double checkedFramesPerSecond(double framesPerSecond, const std::string& where) {
  if (!(framesPerSecond > 0.0 && framesPerSecond <= kMaxFramesPerSecond)) {
    throw InputError(where, "expected a frame rate above 0 and at most " + number(kMaxFramesPerSecond) +
                                " frames/s, found " + number(framesPerSecond));
  }
  return framesPerSecond;
}

}  // namespace promenade::paths
