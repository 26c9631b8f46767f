#include "src/walkthrough/convergence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src/walkthrough/seen.h"
#include "tests/walkthrough/noisy_wall.h"

namespace promenade::walkthrough {
namespace {

using tests::NoisyWall;

constexpr Size kConvergedSize{96, 64};
const Camera kCamera(Pose{}, 1.0, kConvergedSize);

Settings convergenceSettings() {
  Settings s;
  s.size = kConvergedSize;
  s.supersample = 1;
  return s;
}

Converged grey() {
  Frame frame = unshaded(NoisyWall(kConvergedSize, {}, 0).visibility(kCamera));
  for (Rgb& value : frame.diffuse.pixels()) value = Rgb(NoisyWall::kGrey);
  return convergedTo(frame, convergenceSettings());
}

TEST(Convergence, DoublesThePathsUpToTheMost) {
  const NoisyWall wall(
      kConvergedSize, [](int, int) { return 0.1; }, 1);
  std::vector<int> asked;
  renderProgressively(wall, kCamera, convergenceSettings(), 16,
                      [&](const Frame&, int paths, double) { asked.push_back(paths); });
  EXPECT_THAT(asked, testing::ElementsAre(1, 2, 4, 8, 16));
  EXPECT_EQ(wall.pathsOf(5, 5), 16);
}

TEST(Convergence, OfAQuietWallIsThereAtOnce) {
  const NoisyWall wall(
      kConvergedSize, [](int, int) { return 0.0; }, 1);
  for (const ConvergencePoint& point : convergenceOf(wall, kCamera, convergenceSettings(), grey(), 4, 2.5)) {
    EXPECT_EQ(point.percentVisible, 0.0);
    EXPECT_GE(point.seconds, 2.5);
    EXPECT_EQ(point.predictedPercent.has_value(), point.paths > 1);
    EXPECT_LT(point.jnd, 0.01);
    EXPECT_EQ(point.predictedJnd.has_value(), point.paths > 1);
  }
}

TEST(Convergence, OfANoisyWallFallsAndThePredictionBoundsIt) {
  // At 1 per cent of contrast noise of this grain is just visible (method.md): 0.3 needs some 900 paths.
  const NoisyWall wall(
      kConvergedSize, [](int, int) { return 0.3; }, 1);
  const auto points = convergenceOf(wall, kCamera, convergenceSettings(), grey(), 4096, 0.0);
  EXPECT_GT(points.front().percentVisible, 99.0);
  EXPECT_LT(points.back().percentVisible, 1.0);
  for (std::size_t i = 1; i < points.size(); ++i) {
    EXPECT_LE(points[i].percentVisible, points[i - 1].percentVisible + 1.0);
    EXPECT_GE(*points[i].predictedPercent, points[i].percentVisible - 1.0) << points[i].paths;
    EXPECT_LT(points[i].jnd, points[i - 1].jnd) << points[i].paths;
    // The prediction is of two such images: the root of 2 times as much where the difference is small. Where
    // noise is so strong that the display clips it, all such images are too dark alike.
    if (points[i].jnd < 2.0) {
      EXPECT_GT(*points[i].predictedJnd, points[i].jnd) << points[i].paths;
    }
  }
}

}  // namespace
}  // namespace promenade::walkthrough
