#pragma once
// A renderer of scenes whose radiance is known in closed form.

#include "src/core/renderer.h"
#include "tests/ibr/analytic_scene.h"

namespace promenade::tests {

class SceneRenderer final : public Renderer {
 public:
  /// `scene` must outlive this.
  explicit SceneRenderer(const ibr::tests::AnalyticScene& scene) : scene_(scene) {}

  [[nodiscard]] Visibility visibility(const Camera& camera) const override {
    return scene_.visibility(camera);
  }
  [[nodiscard]] Frame render(const Camera& camera, int) const override { return scene_.render(camera); }
  void retrace(Frame& frame, const Mask& mask, SampleSource source, int) const override {
    const Frame whole = scene_.render(frame.visibility.camera);
    for (std::size_t i = 0; i < mask.pixels().size(); ++i) {
      if (mask.pixels()[i] == 0) continue;
      frame.diffuse.pixels()[i] = whole.diffuse.pixels()[i];
      frame.viewDependent.pixels()[i] = whole.viewDependent.pixels()[i];
      frame.source.pixels()[i] = source;
    }
  }
  [[nodiscard]] ItemTraits traits(ItemId) const override { return {}; }
  [[nodiscard]] RayCounts rayCounts() const override { return {}; }

 private:
  const ibr::tests::AnalyticScene& scene_;
};

}  // namespace promenade::tests
