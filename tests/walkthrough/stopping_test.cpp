#include "src/walkthrough/stopping.h"

#include <gtest/gtest.h>

#include <algorithm>

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

NoisyWall evenlyNoisy(double contrast, unsigned seed) {
  return NoisyWall(
      kStoppedSize, [contrast](int, int) { return contrast; }, seed);
}

TEST(Stopping, WhatNeedsNoMorePathsGetsTheFirstOnesOnly) {
  const NoisyWall wall = evenlyNoisy(-1.0, 1);
  const StoppingStatistics spent = trial(wall).spent;
  EXPECT_EQ(spent.paths, 16u * kStoppedSize.area());
  EXPECT_EQ(spent.mostPaths, 16);
  EXPECT_EQ(spent.predictedPercent, 0.0);
  EXPECT_EQ(spent.openTiles, 0);
}

TEST(Stopping, WhatMayBeNoisyIsComparedOnceAtLeast) {
  const NoisyWall wall = evenlyNoisy(0.0, 1);
  const StoppingStatistics spent = trial(wall).spent;
  EXPECT_EQ(spent.paths, 32u * kStoppedSize.area());  // 16, and 16 more that change nothing
  EXPECT_EQ(spent.predictedPercent, 0.0);
}

TEST(Stopping, TwiceTheNoiseTakesFourTimesThePaths) {
  // What counts is contrast / sqrt(paths): twice the contrast is as visible with four times the paths.
  const NoisyWall once = evenlyNoisy(0.05, 1);
  const NoisyWall twice = evenlyNoisy(0.1, 1);
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
    const NoisyWall wall = evenlyNoisy(contrast, 1);
    const NoisyWall other = evenlyNoisy(contrast, 2);
    const NoisyWall converged = evenlyNoisy(0.0, 1);
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
  const NoisyWall wall = evenlyNoisy(1e3, 1);
  const StoppingStatistics spent = trial(wall).spent;
  EXPECT_EQ(spent.mostPaths, 1024);
  EXPECT_EQ(spent.paths, 1024u * kStoppedSize.area());
  EXPECT_EQ(spent.openTiles, 8 * 4);  // of 16 by 16 pixels
  EXPECT_GT(spent.predictedPercent, 50.0);
}

TEST(Stopping, TracesWhatIsSelectedOnly) {
  const NoisyWall wall = evenlyNoisy(0.15, 1);
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

/// Traces every second sample of every second row, and puts the mean of the traced ones around between them.
Trial interpolated(const NoisyWall& wall) {
  Trial t;
  t.frame = unshaded(wall.visibility(Camera(Pose{}, 1.0, kStoppedSize)));
  std::fill(t.frame.diffuse.pixels().begin(), t.frame.diffuse.pixels().end(), Rgb(NoisyWall::kGrey));
  Mask lattice(kStoppedSize);
  for (int y = 0; y < lattice.height(); y += 2) {
    for (int x = 0; x < lattice.width(); x += 2) lattice(x, y) = 1;
  }
  PartSeconds seconds;
  t.spent = traceUntilInvisible(t.frame, lattice, 0, wall, stoppingSettings(), seconds);
  const RadianceMap traced = t.frame.diffuse.clone();
  for (int y = 0; y < lattice.height(); ++y) {
    for (int x = 0; x < lattice.width(); ++x) {
      Rgb sum(0.0f);
      float count = 0.0f;
      for (int j = y - y % 2; j <= y + y % 2; j += 2) {
        for (int i = x - x % 2; i <= x + x % 2; i += 2) {
          if (!lattice.contains(i, j)) continue;
          sum += traced(i, j);
          count += 1.0f;
        }
      }
      t.frame.diffuse(x, y) = sum / count;
    }
  }
  return t;
}

TEST(Stopping, SparseSamplesAreAsNoisyAsWhatIsInterpolatedBetweenThem) {
  const NoisyWall wall = evenlyNoisy(0.15, 1);
  const NoisyWall other = evenlyNoisy(0.15, 2);
  const Trial a = interpolated(wall);
  const Trial b = interpolated(other);
  ASSERT_EQ(a.spent.openTiles, 0);
  EXPECT_LE(percentDifferent(a.frame, b.frame), 2.0);
  EXPECT_GE(a.spent.mostPaths, trial(wall).spent.mostPaths);
}

TEST(Stopping, AnIsolatedSampleProvesNothingOfItsNeighbours) {
  const NoisyWall wall = evenlyNoisy(0.15, 1);
  Trial t;
  t.frame = unshaded(wall.visibility(Camera(Pose{}, 1.0, kStoppedSize)));
  std::fill(t.frame.diffuse.pixels().begin(), t.frame.diffuse.pixels().end(), Rgb(NoisyWall::kGrey));
  Mask mask(kStoppedSize);
  mask(30, 30) = 1;
  PartSeconds seconds;
  t.spent = traceUntilInvisible(t.frame, mask, 0, wall, stoppingSettings(), seconds);
  EXPECT_EQ(t.spent.paths, 32u);
}

TEST(Stopping, NoiseOfATileThatStoppedCountsInTheNextOne) {
  // Around the common corner of four tiles: what is seen there is the noise of all of them.
  const auto spot = [](int x, int y) {
    return (x - 64) * (x - 64) + (y - 32) * (y - 32) < 12 * 12 ? 0.3 : 0.0;
  };
  for (unsigned seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(seed);
    const Trial a = trial(NoisyWall(kStoppedSize, spot, seed));
    const Trial b = trial(NoisyWall(kStoppedSize, spot, 100 + seed));
    ASSERT_EQ(a.spent.openTiles, 0);
    EXPECT_LE(percentDifferent(a.frame, b.frame), 2.0);
  }
}

}  // namespace
}  // namespace promenade::walkthrough
