#include "src/walkthrough/disputed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/walkthrough/analytic_renderer.h"
#include "tests/walkthrough/walks.h"

namespace promenade::walkthrough {
namespace {

using testing::Each;
using testing::ElementsAre;
using tests::AnalyticRenderer;
using tests::kPanel;
using tests::kWall;
using tests::Panel;

/// Of one luminance each.
ibr::Warped warpedOf(Size size, float diffuse, float viewDependent) {
  ibr::Warped warped;
  warped.diffuse = RadianceMap(size, Rgb(diffuse));
  warped.viewDependent = RadianceMap(size, Rgb(viewDependent));
  warped.validity = ibr::ValidityMap(size, ibr::Validity::kValid);
  return warped;
}

WarpedPair panels(Size size, float first, float last) {
  return {{Camera(Pose{}, 1.0, size), DepthMap(size, 1.0f), NormalMap(size), ItemBuffer(size, kPanel)},
          warpedOf(size, 0.5f, first - 0.5f),
          warpedOf(size, 0.5f, last - 0.5f),
          Mask(size)};
}

TEST(DisputedSamples, DifferByMoreThanATenthOfTheLargerLuminance) {
  EXPECT_THAT(disputedSamples(panels({1, 1}, 1.0f, 0.89f)).pixels(), ElementsAre(1));
  EXPECT_THAT(disputedSamples(panels({1, 1}, 0.89f, 1.0f)).pixels(), ElementsAre(1));
  EXPECT_THAT(disputedSamples(panels({1, 1}, 1.0f, 0.91f)).pixels(), ElementsAre(0));
}

TEST(DisputedSamples, AreFilledByBothKeyframesAndShowAnItem) {
  WarpedPair warped = panels({2, 2}, 1.0f, 0.5f);
  warped.fromFirst.validity(0, 0) = ibr::Validity::kOccluded;
  warped.fromLast.validity(1, 0) = ibr::Validity::kOutside;
  warped.target.item(0, 1) = kNoItem;
  EXPECT_THAT(disputedSamples(warped).pixels(), ElementsAre(0, 0, 0, 1));
}

TEST(DisputedSamples, CountOfViewDependentItemsOrOfAll) {
  WarpedPair warped = panels({3, 1}, 1.0f, 0.5f);
  warped.target.item(0, 0) = kWall;
  warped.disputed(0, 0) = warped.disputed(2, 0) = 1;
  const AnalyticRenderer mirror{Panel::kMirrorLike};
  const AnalyticRenderer matt{Panel::kMatt};
  EXPECT_THAT(disputedOf(warped, Disputes::kOfViewDependentItems, mirror).pixels(), ElementsAre(0, 0, 1));
  EXPECT_THAT(disputedOf(warped, Disputes::kOfViewDependentItems, matt).pixels(), Each(0));
  EXPECT_THAT(disputedOf(warped, Disputes::kOfAllItems, matt).pixels(), ElementsAre(1, 0, 1));
}

TEST(DisputedHereAndThere, AreAtMostATenthOfTheirItem) {
  constexpr ItemId kOther = 9;
  WarpedPair warped = panels({30, 1}, 1.0f, 1.0f);
  Mask& disputed = warped.disputed;
  for (int x = 10; x < 30; ++x) warped.target.item(x, 0) = kOther;
  disputed(3, 0) = 1;                                          // one of ten of the panel
  disputed(12, 0) = disputed(17, 0) = 1;                       // two of the other item,
  warped.fromLast.validity(29, 0) = ibr::Validity::kOccluded;  // of whose twenty one cannot be compared
  const ItemSet widely = widelyDisputed(disputed, warped);
  EXPECT_THAT(widely.items(), ElementsAre(kOther));
  const Mask few = disputedHereAndThere(disputed, widely, warped);
  for (int x = 0; x < 30; ++x) EXPECT_EQ(few(x, 0), x == 3 ? 1 : 0) << x;
}

TEST(DisputedSamples, AreTracedInEveryInbetweenThoughTheMiddleProvedTheirItem) {
  const auto path = tests::strafe(9, 0.03);
  Settings settings = tests::settingsFor(path);
  settings.keyframeSpacing = 8;
  settings.tolerancePercent = 100.0;  // no difference is too much for an item
  settings.probeShare = 0.0;
  const AnalyticRenderer renderer{Panel::kMirrorLike};
  const Statistics walk = renderWalkthrough(path, renderer, settings, {});
  ASSERT_EQ(walk.segments.size(), 1u);
  for (std::size_t i = 1; i < 8; ++i) {
    EXPECT_THAT(walk.frames[i].itemsTraced, testing::IsEmpty()) << i;
    EXPECT_GT(walk.frames[i].itemSamples, 0u) << i;
    EXPECT_GT(walk.frames[i].disputed, 0u) << i;
    EXPECT_LE(walk.frames[i].disputed, walk.frames[i].itemSamples) << i;
  }
  const Statistics matt = renderWalkthrough(path, AnalyticRenderer{Panel::kMatt}, settings, {});
  EXPECT_EQ(matt.frames[4].itemSamples, 0u);
  EXPECT_EQ(matt.disputed(), 0u);
}

}  // namespace
}  // namespace promenade::walkthrough
