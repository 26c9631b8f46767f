#pragma once
// A wall a metre away that fills the picture, traced by refine() alone, as derived renderers do that.

#include "src/core/renderer.h"

namespace promenade::tests {

class GreyWall : public Renderer {
 public:
  [[nodiscard]] Visibility visibility(const Camera& camera) const override {
    return {camera, DepthMap(camera.size(), 1.0f), NormalMap(camera.size()), ItemBuffer(camera.size(), 1u)};
  }
  void retrace(Frame&, const Mask&, SampleSource, int) const override {}
  [[nodiscard]] Frame render(const Camera& camera, int) const override {
    return unshaded(visibility(camera));
  }
  [[nodiscard]] ItemTraits traits(ItemId) const override { return {}; }
  [[nodiscard]] RayCounts rayCounts() const override { return {}; }
};

}  // namespace promenade::tests
