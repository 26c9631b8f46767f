#include "src/walkthrough/stopping.h"

#include <gtest/gtest.h>

#include "src/walkthrough/seen.h"
#include "tests/walkthrough/noisy_wall.h"

namespace promenade::walkthrough {
namespace {

using tests::NoisyWall;

constexpr Size kStoppedSize{128, 64};

Settings stoppingSettings() {
  Settings s;
  s.size = kStoppedSize;
  s.supersample = 1;
  s.stopping = StoppingRule{};
  return s;
}

struct Trial {
  Frame frame;
  StoppingStatistics spent;
};

Trial trial(const NoisyWall& wall, const Mask& mask) {
  Trial t;
  t.frame = unshaded(wall.visibility(Camera(Pose{}, 1.0, kStoppedSize)));
  PartSeconds seconds;
  t.spent = traceUntilInvisible(t.frame, mask, 0, wall, stoppingSettings(), seconds);
  return t;
}
Trial trial(const NoisyWall& wall) {
  return trial(wall, Mask(kStoppedSize, 1));
}

/// Of the pixels of two frames; still, as the stopping looks at them.
double percentDifferent(const Frame& a, const Frame& b) {
  const Settings s = stoppingSettings();
  return aqm::percentVisible(aqm::compare(seenOnDisplay(a, 0, s), seenOnDisplay(b, 0, s), VelocityMap(),
                                          aqm::Settings{s.display.pixelsPerDegree()})
                                 .probability,
                             Mask());
}

TEST(Stopping, WhatNeedsNoMorePathsGetsTheFirstOnesOnly) {
  const NoisyWall wall(
      kStoppedSize, [](int, int) { return -1.0; }, 1);
  const StoppingStatistics spent = trial(wall).spent;
  EXPECT_EQ(spent.paths, 16u * kStoppedSize.area());
  EXPECT_EQ(spent.mostPaths, 16);
  EXPECT_EQ(spent.predictedPercent, 0.0);
  EXPECT_EQ(spent.openTiles, 0);
}

TEST(Stopping, WhatMayBeNoisyIsComparedOnceAtLeast) {
  const NoisyWall wall(
      kStoppedSize, [](int, int) { return 0.0; }, 1);
  const StoppingStatistics spent = trial(wall).spent;
  EXPECT_EQ(spent.paths, 32u * kStoppedSize.area());  // 16, and 16 more that change nothing
  EXPECT_EQ(spent.predictedPercent, 0.0);
}

TEST(Stopping, TwiceTheNoiseTakesFourTimesThePaths) {
  // What counts is contrast / sqrt(paths): twice the contrast is as visible with four times the paths.
  const NoisyWall once(
      kStoppedSize, [](int, int) { return 0.05; }, 1);
  const NoisyWall twice(
      kStoppedSize, [](int, int) { return 0.1; }, 1);
  const StoppingStatistics a = trial(once).spent;
  const StoppingStatistics b = trial(twice).spent;
  EXPECT_GT(a.mostPaths, 32);
  EXPECT_LT(b.mostPaths, 1024);
  EXPECT_EQ(b.mostPaths, 4 * a.mostPaths);
}

TEST(Stopping, EasyTilesStopEarly) {
  const NoisyWall wall(
      kStoppedSize, [](int x, int) { return x < 64 ? 0.0 : 0.15; }, 1);
  const StoppingStatistics spent = trial(wall).spent;
  EXPECT_EQ(wall.pathsOf(3, 30), 32);
  EXPECT_GE(wall.pathsOf(120, 30), 128);
  EXPECT_LT(spent.paths, static_cast<std::uint64_t>(spent.mostPaths) * kStoppedSize.area() * 3 / 4);
}

TEST(Stopping, TwoFramesThatStoppedDoNotDifferVisibly) {
  for (const double contrast : {0.03, 0.07, 0.15}) {
    SCOPED_TRACE(contrast);
    const NoisyWall wall(
        kStoppedSize, [=](int, int) { return contrast; }, 1);
    const NoisyWall other(
        kStoppedSize, [=](int, int) { return contrast; }, 2);
    const NoisyWall converged(
        kStoppedSize, [](int, int) { return 0.0; }, 1);
    const Trial a = trial(wall);
    const Trial b = trial(other);
    ASSERT_EQ(a.spent.openTiles, 0);
    // The tolerance is 1 per cent, of a tile; another one for having stopped when chance was kind.
    EXPECT_LE(percentDifferent(a.frame, b.frame), 2.0);
    EXPECT_LE(percentDifferent(a.frame, trial(converged).frame), 1.0);
    EXPECT_LE(a.spent.predictedPercent, 1.0);
  }
}

TEST(Stopping, NoiseThatCannotBeHelpedEndsAtTheMostPathsAndSaysWhatRemains) {
  const NoisyWall wall(
      kStoppedSize, [](int, int) { return 1e3; }, 1);
  const StoppingStatistics spent = trial(wall).spent;
  EXPECT_EQ(spent.mostPaths, 1024);
  EXPECT_EQ(spent.paths, 1024u * kStoppedSize.area());
  EXPECT_EQ(spent.openTiles, 8 * 4);  // of 16 by 16 pixels
  EXPECT_GT(spent.predictedPercent, 50.0);
}

TEST(Stopping, TracesWhatIsSelectedOnly) {
  const NoisyWall wall(
      kStoppedSize, [](int, int) { return 0.15; }, 1);
  Mask mask(kStoppedSize);
  for (int y = 20; y < 40; ++y) {
    for (int x = 30; x < 60; ++x) mask(x, y) = 1;
  }
  const Trial t = trial(wall, mask);
  EXPECT_EQ(wall.pathsOf(29, 30), 0);
  EXPECT_EQ(t.frame.diffuse(29, 30), Rgb(0.0f));
  EXPECT_GE(wall.pathsOf(45, 30), 32);
  EXPECT_NEAR(t.frame.diffuse(45, 30).x, NoisyWall::kGrey, 0.1f);
}

}  // namespace
}  // namespace promenade::walkthrough
