#include "src/walkthrough/progressive_picture.h"

#include <gtest/gtest.h>

#include "src/walkthrough/seen.h"
#include "tests/walkthrough/timed_wall.h"

namespace promenade::walkthrough {
namespace {

using tests::TimedWall;
using tests::WallLook;

constexpr Size kPictureSize{96, 64};
const Camera kPictureCamera(Pose{}, 1.0, kPictureSize);

Settings pictureSettings() {
  Settings s;
  s.size = kPictureSize;
  s.supersample = 1;
  return s;
}

struct TracedPicture {
  explicit TracedPicture(const WallLook& look) : wall(look, now) {}

  double now = 0.0;
  TimedWall wall;
  Settings at = pictureSettings();
  Clock clock = [this] { return now; };
  ProgressivePicture picture{wall, kPictureCamera, at, clock};
};

TEST(RmsContrast, IsTheRelativeDifferenceOfPicturesThatAreNearlyAlike) {
  LuminanceMap a(Size{2, 1});
  LuminanceMap b(Size{2, 1});
  a(0, 0) = 110.0f;
  b(0, 0) = 90.0f;  // 2 * 20 / 200
  a(1, 0) = b(1, 0) = 50.0f;
  EXPECT_NEAR(rmsContrast(a, b), 0.2 / std::sqrt(2.0), 1e-6);
  EXPECT_EQ(rmsContrast(a, a), 0.0);
  a(1, 0) = 1e6f;  // a single dot counts as 2 at most
  EXPECT_NEAR(rmsContrast(a, b), std::sqrt((0.04 + 4.0) / 2.0), 1e-3);
}

TEST(ProgressivePicture, TakesPowersOfTwoThatDivideItsPaths) {
  TracedPicture t({.contrast = 0.1});
  const double long_ = 1e9;
  const int all = 1 << 20;
  EXPECT_EQ(t.picture.affordable(long_, all), 1);
  for (const int count : {1, 1, 2, 4}) t.picture.trace(count);
  EXPECT_EQ(t.picture.affordable(long_, all), 8);
  EXPECT_EQ(t.picture.affordable(long_, 7), 4);
  EXPECT_EQ(t.picture.affordable(5.5, all), 4);  // a path takes a second
  EXPECT_EQ(t.picture.affordable(0.9, all), 0);
  EXPECT_EQ(t.picture.affordable(-1.0, all), 0);
  t.picture.trace(4);
  EXPECT_EQ(t.picture.paths(), 12);
  EXPECT_EQ(t.picture.affordable(long_, all), 4);
  EXPECT_DOUBLE_EQ(t.picture.seconds(), 12.0);
  EXPECT_DOUBLE_EQ(t.picture.secondsFor(3), 3.0);
}

TEST(ProgressivePicture, KnowsNothingOfItsErrorFromASinglePath) {
  TracedPicture t({.contrast = 0.1});
  t.picture.trace(1);
  EXPECT_FALSE(t.picture.error());
  EXPECT_FALSE(t.picture.predictedPercent());
}

TEST(ProgressivePicture, KnowsItsErrorWhereverItStops) {
  // After 1, 2, 3, 4, 6, 8, 12 paths; the truth is the distance to a wall without noise. Two estimates from
  // 6144 pixels differ by 2 per cent; from four paths after eight it is half as sharp.
  TracedPicture clean({.contrast = 0.0});
  clean.picture.trace(1);
  const Settings s = pictureSettings();
  const LuminanceMap truth = seenOnDisplay(clean.picture.picture(), 0, s);
  TracedPicture t({.contrast = 0.2});
  t.picture.trace(1);
  for (const int count : {1, 1, 1, 2, 2, 4}) {
    t.picture.trace(t.picture.paths() % count == 0 ? count : 1);
    SCOPED_TRACE(t.picture.paths());
    const double error = rmsContrast(seenOnDisplay(t.picture.picture(), 0, s), truth);
    EXPECT_NEAR(t.picture.error().value(), error, 0.1 * error);
  }
}

TEST(ProgressivePicture, IsCleanWhenNoSampleNeedsMore) {
  TracedPicture t({.contrast = 0.0});
  EXPECT_FALSE(t.picture.isClean());
  t.picture.trace(1);
  EXPECT_TRUE(t.picture.isClean());
}

TEST(ProgressivePicture, PredictsThatMuchNoiseIsSeenAndLittleIsNot) {
  for (const auto& [contrast, least, most] : {std::tuple(0.5, 99.0, 100.0), std::tuple(0.001, 0.0, 0.0)}) {
    TracedPicture t({.contrast = contrast});
    for (const int count : {1, 1, 2}) t.picture.trace(count);
    EXPECT_GE(t.picture.predictedPercent().value(), least);
    EXPECT_LE(t.picture.predictedPercent().value(), most);
  }
}

}  // namespace
}  // namespace promenade::walkthrough
