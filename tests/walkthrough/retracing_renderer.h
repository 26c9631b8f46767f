#pragma once
// What renderers of tests have in common: a whole frame is one that is retraced everywhere.

#include "src/core/renderer.h"

namespace promenade::tests {

/// The rest is visibility() and retrace(), which writes every sample that it is asked for.
class RetracingRenderer : public Renderer {
 public:
  [[nodiscard]] Frame render(const Camera& camera, int frameIndex) const override {
    Frame frame = unshaded(visibility(camera));
    retrace(frame, Mask(camera.size(), 1), SampleSource::kTraced, frameIndex);
    return frame;
  }
  [[nodiscard]] ItemTraits traits(ItemId) const override { return {}; }
  [[nodiscard]] RayCounts rayCounts() const override { return {}; }
};

}  // namespace promenade::tests
