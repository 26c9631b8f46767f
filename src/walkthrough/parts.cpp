#include <algorithm>

#include "src/walkthrough/walkthrough.h"

namespace promenade::walkthrough {

Plan equalPartsOf(const Settings& settings) {
  // Filtered frames need others.
  if (settings.method == Method::kImageBased || settings.antialiasing) {
    return equalSegments(settings.frames, settings.keyframeSpacing);
  }
  Plan frames;
  for (int frame = settings.frames.first; frame <= settings.frames.last; ++frame) {
    frames.push_back({frame, frame, 0});
  }
  return frames;
}

FrameRange framesOf(const Segment& part, FrameRange walk) {
  return {part.first, part.last == walk.last ? part.last : std::max(part.first, part.last - 1)};
}

}  // namespace promenade::walkthrough
