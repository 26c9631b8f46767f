#include "src/core/adaptation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace promenade {
namespace {

TEST(FovealLuminances, AreMeansOfNearlySquareParts) {
  RadianceMap radiance(8, 4, Rgb(1.0f));
  for (int y = 0; y < 4; ++y) radiance(7, y) = Rgb(3.0f);
  // 4 columns of 2 pixels, 2 rows of 2: of the last column half the pixels are 3.
  EXPECT_THAT(fovealLuminances(radiance, 4),
              testing::Pointwise(testing::DoubleNear(1e-6), {1.0, 1.0, 1.0, 2.0, 1.0, 1.0, 1.0, 2.0}));
  EXPECT_EQ(fovealLuminances(radiance).size(), 32u);  // as many as there are
  EXPECT_EQ(fovealLuminances(RadianceMap(1, 1, Rgb(1.0f))).size(), 1u);
}

TEST(FovealLuminances, LeaveOutWhatIsNotFinite) {
  RadianceMap radiance(2, 1, Rgb(2.0f));
  radiance(0, 0) = Rgb(std::numeric_limits<float>::infinity());
  EXPECT_THAT(fovealLuminances(radiance, 1), testing::ElementsAre(testing::DoubleNear(2.0, 1e-6)));
  radiance(1, 0) = Rgb(std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(fovealLuminances(radiance, 1).empty());
}

TEST(LogAverage, IsTheGeometricMean) {
  EXPECT_NEAR(logAverage({1.0, 100.0, 10.0}), 10.0, 1e-9);
  // A black quarter counts as 1/100 of the mean, 0.0075: the fourth root of 0.0075.
  EXPECT_NEAR(logAverage({1.0, 0.0, 1.0, 1.0}), std::pow(0.0075, 0.25), 1e-9);
  EXPECT_EQ(logAverage({}), 0.0);
  EXPECT_EQ(logAverage({0.0, 0.0}), 0.0);
  EXPECT_EQ(logAverage({0.1, 7.0, 0.3}), logAverage({7.0, 0.3, 0.1}));
}

TEST(AdaptationCurve, StaysWhereTheLightStays) {
  const AdaptationCurve curve({{10, 30.0}, {20, 30.0}}, 25.0);
  for (const int frame : {0, 10, 13, 20, 99}) {
    EXPECT_NEAR(curve.at(frame).steady, 30.0, 1e-9);
    EXPECT_NEAR(curve.at(frame).now, 30.0, 1e-9);
  }
  EXPECT_EQ(AdaptationCurve().at(3).now, 100.0);
}

TEST(AdaptationCurve, IsInterpolatedInTheLogarithmBetweenViews) {
  const AdaptationCurve curve({{0, 1.0}, {4, 16.0}}, 25.0);
  EXPECT_NEAR(curve.at(1).steady, 2.0, 1e-9);
  EXPECT_NEAR(curve.at(3).steady, 8.0, 1e-9);
  EXPECT_NEAR(curve.at(4).steady, 16.0, 1e-9);
}

TEST(AdaptationCurve, FollowsAStepInTheLightAsFastAsRodsAndConesDo) {
  // The light goes on: at 1000 cd/m2 cones see, tau = 0.1 s, but for 0.04 / 1000.04 * 0.3 s = 1.2e-5 s. After
  // 0.1 s, 10 frames of 100 a second, 1 - 1/e of the way is done.
  const AdaptationCurve on({{0, 1.0}, {1, 1000.0}, {100, 1000.0}}, 100.0);
  EXPECT_NEAR(on.at(0).now, 1.0, 1e-12);
  EXPECT_NEAR(on.at(10).now, 1.0 + 999.0 * (1.0 - std::exp(-1.0)), 0.1);
  EXPECT_NEAR(on.at(100).now, 1000.0, 0.1);
  // The light goes out: at 0.001 cd/m2 rods see, s = 0.04 / 0.041 = 0.975610, tau = 0.392683 s. After 0.4 s
  // 0.4 / 0.392683 = 1.018633 time constants: exp(-1.018633) = 0.361088 is left.
  const AdaptationCurve off({{0, 100.0}, {1, 0.001}, {100, 0.001}}, 100.0);
  EXPECT_NEAR(off.at(40).now, 36.1088, 0.01);
  EXPECT_EQ(off.at(40).steady, off.at(99).steady);
}

TEST(AdaptationCurve, NeverJumpsAndNeverOvershoots) {
  const AdaptationCurve curve({{0, 0.01}, {1, 5000.0}, {50, 5000.0}, {51, 0.01}, {100, 0.01}}, 25.0);
  for (int frame = 1; frame <= 100; ++frame) {
    const double before = curve.at(frame - 1).now;
    const double now = curve.at(frame).now;
    const double steady = curve.at(frame).steady;
    // 1 - exp(-0.04 s / 0.1 s) = 0.33 of the way a frame, at most.
    EXPECT_LE(std::abs(now - before), 0.33 * std::abs(steady - before) + 1e-9) << frame;
    EXPECT_GE((steady - now) * (steady - before), 0.0) << frame;
  }
}

TEST(AdaptationCurve, IsFiniteInTheDark) {
  const AdaptationCurve curve({{0, 0.0}, {5, 0.0}}, 25.0);
  EXPECT_GT(curve.at(3).now, 0.0);
}

TEST(FramesToView, AreAtMostEightASecondWithBothEnds) {
  // 25 / 8 = 3.1: every fourth frame.
  EXPECT_THAT(framesToView(3, 12, 25.0), testing::ElementsAre(3, 7, 11, 12));
  EXPECT_THAT(framesToView(0, 8, 25.0), testing::ElementsAre(0, 4, 8));
  EXPECT_THAT(framesToView(5, 5, 25.0), testing::ElementsAre(5));
  EXPECT_THAT(framesToView(0, 2, 1.0), testing::ElementsAre(0, 1, 2));
}

}  // namespace
}  // namespace promenade
