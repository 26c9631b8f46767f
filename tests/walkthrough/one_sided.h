#pragma once
// Walks of a single segment whose gloss is known in closed form.

#include <algorithm>
#include <cstddef>
#include <optional>

#include "tests/walkthrough/walks.h"

namespace promenade::tests {

/// What a walk makes of samples that one side in time alone shows.
struct OneSided {
  int warped = 0;      ///< samples that kept what that side shows
  int traced = 0;      ///< samples that were traced as holes
  double worst = 0.0;  ///< error of the warped ones
  std::size_t segments = 0;
};

/// All frames of the path as one segment, which nothing splits. `errorAt(frame, camera, x, y)`: of the warped
/// radiance of a sample; nothing for a sample that is not to be counted.
template <class ErrorAt>
[[nodiscard]] OneSided walkOneSegment(const paths::CameraPath& path, const Renderer& renderer, Size size,
                                      const ErrorAt& errorAt) {
  walkthrough::Settings settings = settingsFor(path, size, 1);
  settings.keyframeSpacing = static_cast<int>(path.frames.size()) - 1;
  settings.tolerancePercent = 100.0;  // no difference splits it
  settings.probeShare = 0.0;
  OneSided found;
  walkthrough::Outputs outputs;
  outputs.frame = [&](walkthrough::FinishedFrame&& frame) {
    const paths::PathFrame& at = path.frames[static_cast<std::size_t>(frame.index)];
    const Camera camera(at.pose, at.verticalFieldOfView, settings.size);
    for (int y = 0; y < settings.size.height; ++y) {
      for (int x = 0; x < settings.size.width; ++x) {
        const std::optional<double> error = errorAt(frame, camera, x, y);
        if (!error) continue;
        const SampleSource source = frame.source(x, y);
        if (source == SampleSource::kTracedHole) ++found.traced;
        if (source != SampleSource::kWarpedFromPrevious && source != SampleSource::kWarpedFromNext) continue;
        ++found.warped;
        found.worst = std::max(found.worst, *error);
      }
    }
  };
  found.segments = walkthrough::renderWalkthrough(path, renderer, settings, outputs).segments.size();
  return found;
}

}  // namespace promenade::tests
