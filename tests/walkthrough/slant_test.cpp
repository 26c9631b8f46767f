#include "src/walkthrough/slant.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "tests/walkthrough/one_sided.h"
#include "tests/walkthrough/retracing_renderer.h"
#include "tests/walkthrough/walks.h"

namespace promenade::walkthrough {
namespace {

constexpr ItemId kGround = 1;

/// One sample of a wall, half of it gloss, that only a later source shows.
class SlantedGloss : public testing::Test {
 protected:
  SlantedGloss() {
    blended.frame = {
        {Camera(Pose{}, 1.0, {1, 1}), DepthMap(1, 1, 10.0f), NormalMap(1, 1), ItemBuffer(1, 1, kGround)},
        RadianceMap(1, 1, Rgb(0.5f)),
        RadianceMap(1, 1, Rgb(0.5f)),
        SourceMap(1, 1, SampleSource::kWarpedFromNext)};
    blended.holes = Mask(1, 1);
  }
  [[nodiscard]] int isSelectedIfChangedBy(float change) {
    blended.slantChange = decltype(ibr::Blended::slantChange)(1, 1, change);
    return holesAndSlantedGloss(blended, looksTheSame)(0, 0);
  }

  ibr::Blended blended;
  Mask looksTheSame{1, 1, 1};
};

TEST_F(SlantedGloss, CountsIfItsChangeIsMoreThanFivePercentOfTheSample) {
  EXPECT_EQ(isSelectedIfChangedBy(0.09f), 0);  // half of 0.09
  EXPECT_EQ(isSelectedIfChangedBy(0.11f), 1);
  blended.frame.viewDependent(0, 0) = Rgb(0.4f);  // 0.4 / 0.9 of 0.11 is 0.049
  EXPECT_EQ(isSelectedIfChangedBy(0.11f), 0);
}

TEST_F(SlantedGloss, DoesNotMatterWhereThereIsNone) {
  blended.frame.viewDependent(0, 0) = Rgb(0.0f);
  EXPECT_EQ(isSelectedIfChangedBy(2.0f), 0);
  blended.frame.diffuse(0, 0) = Rgb(0.0f);
  EXPECT_EQ(isSelectedIfChangedBy(2.0f), 0);
}

TEST_F(SlantedGloss, OfItemsThatCountAsViewDependentIsForTheirVerdict) {
  EXPECT_EQ(isSelectedIfChangedBy(0.5f), 1);
  looksTheSame(0, 0) = 0;
  EXPECT_EQ(isSelectedIfChangedBy(0.5f), 0);
}

TEST_F(SlantedGloss, LeavesHolesHoles) {
  blended.holes(0, 0) = 1;
  EXPECT_EQ(isSelectedIfChangedBy(0.0f), 1);
}

/// A level street without end. A third of what it shows from right above is gloss, which goes by one over the
/// cosine to its normal.
class Street final : public tests::RetracingRenderer {
 public:
  static constexpr double kEyeHeight = 1.5;
  static constexpr float kDiffuse = 0.2f;

  static Rgb gloss(const Camera& camera, int x, int y) {
    const glm::dvec3 d = camera.direction({x + 0.5, y + 0.5});
    return Rgb(static_cast<float>(0.1 * glm::length(d) / -d.y));
  }

  [[nodiscard]] Visibility visibility(const Camera& camera) const override {
    const Size size = camera.size();
    Visibility v{camera, DepthMap(size, std::numeric_limits<float>::infinity()), NormalMap(size),
                 ItemBuffer(size, kNoItem)};
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        const glm::dvec3 d = camera.direction({x + 0.5, y + 0.5});
        if (d.y >= 0.0) continue;
        v.depth(x, y) = static_cast<float>(kEyeHeight / -d.y);
        v.normal(x, y) = glm::vec3(0.0f, 1.0f, 0.0f);
        v.item(x, y) = kGround;
      }
    }
    return v;
  }
  void retrace(Frame& frame, const Mask& mask, SampleSource source, int) const override {
    for (int y = 0; y < mask.height(); ++y) {
      for (int x = 0; x < mask.width(); ++x) {
        if (mask(x, y) == 0) continue;
        frame.source(x, y) = source;
        if (frame.visibility.item(x, y) == kNoItem) continue;
        frame.diffuse(x, y) = Rgb(kDiffuse);
        frame.viewDependent(x, y) = gloss(frame.visibility.camera, x, y);
      }
    }
  }
};

TEST(SlantedGlossOfAStreet, IsNotTakenFromAKeyframeThatSeesItSteeply) {
  // 0.5 m a frame, keyframes 4 m apart. What lies d metres ahead, a keyframe s metres behind saw finely
  // enough if ((d + s) / d)^3 is at most 2.5: beyond 8 m for 3 m. Nearer, down to 2.7 m + 1 m (the picture's
  // lower edge is half a radian below the horizon), frame 6 has it from the next keyframe alone, 1 m ahead,
  // where ln(cos' / cos) is up to ln(0.48 / 0.37), of what is two thirds gloss. Frames before it see more of
  // it so, and without this test the worst logarithm of all is 0.25. In a tall picture most of it is farther
  // from what both keyframes show than moved_gloss.h looks.
  constexpr int kLast = 8;
  auto path = tests::still(kLast + 1);
  for (int i = 0; i <= kLast; ++i) path.frames[static_cast<std::size_t>(i)].pose.eye.z = -0.5 * i;
  const tests::OneSided found = tests::walkOneSegment(
      path, Street(), {16, 288},
      [](const FinishedFrame& frame, const Camera& camera, int x, int y) -> std::optional<double> {
        // Farther, a row of samples differs from the next by more than is asked here.
        if (!(frame.visibility.depth(x, y) < 10.0f)) return std::nullopt;
        const double truth = Street::kDiffuse + luminance(Street::gloss(camera, x, y));
        return std::abs(std::log(luminance(frame.radiance(x, y)) / truth));
      });
  EXPECT_EQ(found.segments, 1u);
  EXPECT_GT(found.warped, 30);
  EXPECT_GT(found.traced, 300);
  // What is asked is share * change <= 0.05, by the warped share; the logarithm is a little more curved.
  EXPECT_LT(found.worst, 0.055);
}

}  // namespace
}  // namespace promenade::walkthrough
