// A surface that looks different from elsewhere is warped from samples that face as it does.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "tests/walkthrough/analytic_renderer.h"
#include "tests/walkthrough/walks.h"

namespace promenade::walkthrough {
namespace {

using tests::AnalyticRenderer;
using tests::kPanel;
using tests::Panel;

constexpr double kStep = 0.03;
constexpr int kLast = 8;
constexpr int kMiddle = 4;

/// The panel's normals in the middle frame are not those that the keyframes saw, as on a handle finer than a
/// sample.
class TurnedInTheMiddle final : public Renderer {
 public:
  TurnedInTheMiddle(Panel panel, double degrees)
      : panel_(panel), radians_(degrees * std::numbers::pi / 180.0) {}

  [[nodiscard]] Visibility visibility(const Camera& camera) const override {
    Visibility v = panel_.visibility(camera);
    if (std::abs(camera.pose().eye.x - kMiddle * kStep) > 1e-9) return v;
    for (std::size_t i = 0; i < v.item.pixels().size(); ++i) {
      if (v.item.pixels()[i] == kPanel)
        v.normal.pixels()[i] = glm::vec3(std::sin(radians_), 0.0, std::cos(radians_));
    }
    return v;
  }
  void retrace(Frame& frame, const Mask& mask, SampleSource source, int frameIndex) const override {
    panel_.retrace(frame, mask, source, frameIndex);
  }
  [[nodiscard]] Frame render(const Camera& camera, int frameIndex) const override {
    return panel_.render(camera, frameIndex);
  }
  [[nodiscard]] ItemTraits traits(ItemId item) const override { return panel_.traits(item); }
  [[nodiscard]] RayCounts rayCounts() const override { return panel_.rayCounts(); }

 private:
  AnalyticRenderer panel_;
  double radians_;
};

std::uint64_t tracedOfMiddle(Panel panel, double degrees) {
  const auto path = tests::strafe(kLast + 1, kStep);
  Settings settings = tests::settingsFor(path);
  settings.keyframeSpacing = kLast;
  settings.tolerancePercent = 100.0;  // no difference is too much
  settings.probeShare = 0.0;
  const Statistics walk = renderWalkthrough(path, TurnedInTheMiddle(panel, degrees), settings, {});
  EXPECT_EQ(walk.segments.size(), 1u);
  return walk.frames[kMiddle].samplesTraced;
}

std::uint64_t samplesOnPanel() {
  const auto path = tests::strafe(kMiddle + 1, kStep);
  const Camera camera(path.frames.back().pose, path.frames.back().verticalFieldOfView,
                      {2 * tests::kWalkSize.width, 2 * tests::kWalkSize.height});
  const Visibility seen = AnalyticRenderer{Panel::kMatt}.visibility(camera);
  const auto items = seen.item.pixels();
  return static_cast<std::uint64_t>(std::count(items.begin(), items.end(), kPanel));
}

TEST(TurnedSurfaces, ThatMirrorAreNotWarpedAcrossHalfTheCreaseAngle) {
  // 8 and 12 degrees: less and more than half of 18. The panel as a whole comes free, and nothing else.
  EXPECT_EQ(tracedOfMiddle(Panel::kGlossy, 8.0), tracedOfMiddle(Panel::kGlossy, 0.0));
  EXPECT_GE(tracedOfMiddle(Panel::kGlossy, 12.0), samplesOnPanel());
}

TEST(TurnedSurfaces, ThatLookTheSameFromEverywhereAreWarpedUpToTheCreaseAngle) {
  EXPECT_EQ(tracedOfMiddle(Panel::kMatt, 12.0), tracedOfMiddle(Panel::kMatt, 0.0));
  EXPECT_GE(tracedOfMiddle(Panel::kMatt, 24.0), samplesOnPanel());
}

}  // namespace
}  // namespace promenade::walkthrough
