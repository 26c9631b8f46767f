#include "src/core/renderer.h"

namespace promenade {

RayCounts operator-(const RayCounts& now, const RayCounts& before) {
  return {now.visibility - before.visibility, now.primary - before.primary, now.scattered - before.scattered,
          now.shadow - before.shadow};
}

RayCounts& RayCounts::operator+=(const RayCounts& more) {
  visibility += more.visibility;
  primary += more.primary;
  scattered += more.scattered;
  shadow += more.shadow;
  return *this;
}

Visibility Renderer::visibilityAmong(const Camera& camera, std::span<const Frame* const>) const {
  return visibility(camera);
}

Refined Renderer::refine(Frame& frame, const Mask& mask, PathRange paths, int frameIndex) const {
  if (paths.before == 0) retrace(frame, mask, SampleSource::kTraced, frameIndex);
  return {Mask(mask.size()), 0};
}

}  // namespace promenade
