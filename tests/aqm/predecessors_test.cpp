#include "aqm/predecessors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "aqm/csf.h"
#include "src/core/errors.h"
#include "tests/aqm/patterns.h"

namespace promenade::aqm {
namespace {

using tests::frameOf;
using tests::pi;

constexpr double kModelPpd = 32.0;
constexpr Size kModelSize{64, 48};

/// 4 cycles per degree along x: 8 periods.
LuminanceMap grating(double contrast, double phase = 0.0) {
  return frameOf(kModelSize,
                 [=](int x, int) { return 50.0 * (1.0 + contrast * std::cos(2.0 * pi * x / 8.0 + phase)); });
}

// Differences 3, 0, 0, -4: sqrt(25 / 4) = 2.5. 20 log10(250 / 2.5) = 40.
TEST(Rmse, IsTheRootOfTheMeanSquare) {
  LuminanceMap a(2, 2, 10.0f);
  LuminanceMap b(2, 2, 10.0f);
  a(0, 0) = 13.0f;
  b(1, 1) = 14.0f;
  EXPECT_DOUBLE_EQ(rmse(a, b), 2.5);
  EXPECT_DOUBLE_EQ(psnr(a, b, 250.0), 40.0);
  EXPECT_EQ(psnr(a, a, 250.0), std::numeric_limits<double>::infinity());
}

// cbrt(1 + c cos) = 1 + c/3 cos + ..; the mean square of a cosine of amplitude a is a^2 / 2, weighted with
// the CSF at 4 cycles per degree.
TEST(RushmeierModel1, OfAFaintGratingIsItsWeightedMeanSquare) {
  const double weight = mannosSakrisonSensitivity(4.0) / 250.0;
  const double expected = std::pow(0.01 / 3.0 * weight, 2.0) / 2.0;
  EXPECT_NEAR(rushmeierModel1(grating(0.01), grating(0.0), kModelPpd), expected, 1e-3 * expected);
}

TEST(RushmeierModel1, SeesNeitherAShiftNorAnExposure) {
  const double seen = rushmeierModel1(grating(0.3), grating(0.2), kModelPpd);
  EXPECT_LT(rushmeierModel1(grating(0.3), grating(0.3, pi / 4.0), kModelPpd), 1e-4 * seen);
  const LuminanceMap bright =
      frameOf(kModelSize, [](int x, int) { return 100.0 * (1.0 + 0.3 * std::cos(2.0 * pi * x / 8.0)); });
  EXPECT_LT(rushmeierModel1(grating(0.3), bright, kModelPpd), 1e-4 * seen);
}

// Quarter of a period: |c - c i| = sqrt(2) c; root of the mean square sqrt(2) c / sqrt(2) = c, weighted.
TEST(RushmeierModel2, SeesAShift) {
  const double area = 64.0 * 48.0 / (32.0 * 32.0);
  const double weight = dalySensitivity(4.0, 0.0, {100.0, area}) / 250.0;
  EXPECT_NEAR(rushmeierModel2(grating(0.2), grating(0.2, pi / 2.0), kModelPpd), 0.2 * weight,
              1e-3 * 0.2 * weight);
}

// The oblique effect: the same grating along a diagonal is seen less.
TEST(RushmeierModel2, SeesDiagonalsLess) {
  const auto diagonal = [](double contrast) {
    return frameOf(
        {64, 64}, [=](int x, int y) { return 50.0 * (1.0 + contrast * std::cos(2.0 * pi * (x + y) / 8.0)); });
  };
  const auto upright = [](double contrast) {
    // 1/8 sqrt(2) cycles per pixel, but for 2 % (11 periods in 64 pixels).
    return frameOf(
        {64, 64}, [=](int x, int) { return 50.0 * (1.0 + contrast * std::cos(2.0 * pi * 11.0 * x / 64.0)); });
  };
  EXPECT_LT(rushmeierModel2(diagonal(0.1), diagonal(0.0), kModelPpd),
            0.97 * rushmeierModel2(upright(0.1), upright(0.0), kModelPpd));
}

// dR/dL L = 0.37 R (1 - R): amplitude 0.01 * 0.37 * R(50) (1 - R(50)) with R(50) = 0.25247.
TEST(RushmeierModel3, OfAFaintGratingIsItsWeightedMeanSquare) {
  const double area = 64.0 * 48.0 / (32.0 * 32.0);
  const double weight = dalySensitivity(4.0, 0.0, {50.0, area}) / 250.0;
  const double amplitude = 0.01 * 0.37 * 0.25247 * (1.0 - 0.25247);
  const double expected = std::pow(amplitude * weight, 2.0) / 2.0;
  EXPECT_NEAR(rushmeierModel3(grating(0.01), grating(0.0), kModelPpd), expected, 2e-3 * expected);
}

TEST(Predecessors, AreSymmetricAndZeroForEqualFrames) {
  const LuminanceMap a = frameOf({13, 7}, [](int x, int y) { return 20.0 + (x * 7 + y * 5) % 9; });
  const LuminanceMap b = frameOf({13, 7}, [](int x, int y) { return 20.0 + (x * 3 + y * 8) % 7; });
  for (const auto model : {rushmeierModel1, rushmeierModel2, rushmeierModel3}) {
    EXPECT_EQ(model(a, a, kModelPpd), 0.0);
    EXPECT_GT(model(a, b, kModelPpd), 0.0);
    EXPECT_DOUBLE_EQ(model(a, b, kModelPpd), model(b, a, kModelPpd));
  }
}

TEST(Predecessors, NeedTwoFramesOfOneSizeAndOfLight) {
  EXPECT_THROW((void)rmse(LuminanceMap(2, 1, 1.0f), LuminanceMap(1, 2, 1.0f)), InputError);
  EXPECT_THROW((void)rmse({}, {}), InputError);
  EXPECT_THROW((void)rushmeierModel1(LuminanceMap(2, 1, 0.0f), LuminanceMap(2, 1, 1.0f), kModelPpd),
               InputError);
}

}  // namespace
}  // namespace promenade::aqm
