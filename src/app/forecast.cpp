#include "src/app/forecast.h"

#include <algorithm>

#include "src/app/formatted.h"
#include "src/app/progress_line.h"

namespace promenade::app {

void Forecast::keyframeRendered(double seconds) {
  ++keyframesRendered_;
  secondsInKeyframes_ += seconds;
}

void Forecast::frameFinished(bool keyframe) {
  ++framesFinished_;
  if (keyframe) ++keyframesFinished_;
}

double Forecast::keyframeSeconds() const {
  return keyframesRendered_ > 0 ? secondsInKeyframes_ / keyframesRendered_ : 0.0;
}

std::string Forecast::firstEstimate() const {
  const double each = keyframeSeconds();
  std::string line = "a keyframe takes " + (each < 1.0 ? formatted("%.2fs", each) : duration(each));
  line += ": " + duration(fewestKeyframes_ * each);
  if (fewestKeyframes_ < frames_) line += " to " + duration(frames_ * each);
  return line + " for " + (frames_ == 1 ? "the frame" : "all " + std::to_string(frames_) + " frames");
}

std::optional<double> Forecast::secondsLeft(double elapsed) const {
  if (framesFinished_ == 0) return std::nullopt;
  const double ahead = (keyframesRendered_ - keyframesFinished_) * keyframeSeconds();
  const double each = std::max(elapsed - ahead, 0.0) / framesFinished_;
  return std::max((frames_ - framesFinished_) * each - ahead, 0.0);
}

}  // namespace promenade::app
