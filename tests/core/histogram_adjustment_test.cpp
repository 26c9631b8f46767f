#include "src/core/histogram_adjustment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "src/core/adaptation.h"

namespace promenade {
namespace {

constexpr DisplayRange kTube{0.5, 100.0};

/// As much of every luminance from 10^low to 10^high.
LightHistogram evenly(double low, double high) {
  std::vector<double> luminances;
  for (int i = 0; i <= 1000; ++i) luminances.push_back(std::pow(10.0, low + (high - low) * i / 1000.0));
  return lightHistogram(luminances);
}

double logSlope(const HistogramAdjustment& shown, double luminance) {
  const double step = 1.001;
  return std::log(shown(luminance * step) / shown(luminance)) / std::log(step);
}

TEST(LightHistogram, SharesALuminanceBetweenTheBinsAroundIt) {
  // log10 = 1.0125 is a quarter of the way from bin 100 (10^1) to bin 101 (10^1.05).
  const std::vector<double> one = {std::pow(10.0, 1.0125)};
  const LightHistogram histogram = lightHistogram(one);
  EXPECT_NEAR(histogram.shares[100], 0.75, 1e-9);
  EXPECT_NEAR(histogram.shares[101], 0.25, 1e-9);
  const std::vector<double> extremes = {0.0, 1e30};
  EXPECT_NEAR(lightHistogram(extremes).shares.front(), 0.5, 1e-9);
  EXPECT_NEAR(lightHistogram(extremes).shares.back(), 0.5, 1e-9);
  EXPECT_TRUE(lightHistogram({}).shares.empty());
}

TEST(LightHistogram, FollowsTheWalkLikeTheEye) {
  // Light of 10 cd/m2 becomes 1000; views half a second apart. tau at 1000 cd/m2 is 0.100012 s: exp(-5) is
  // left of the old.
  const AdaptationCurve curve({viewOf(0, {1.0}, 10.0), viewOf(50, {1.0}, 1000.0)}, 100.0);
  EXPECT_NEAR(curve.histogramAt(0).shares[100], 1.0, 1e-9);
  EXPECT_NEAR(curve.histogramAt(50).shares[100], std::exp(-5.0), 1e-5);
  EXPECT_NEAR(curve.histogramAt(50).shares[140], 1.0 - std::exp(-5.0), 1e-5);
  EXPECT_NEAR(curve.histogramAt(25).shares[140], 0.5 * (1.0 - std::exp(-5.0)), 1e-5);
  const std::vector<double> all = curve.histogramAt(25).shares;
  EXPECT_NEAR(std::accumulate(all.begin(), all.end(), 0.0), 1.0, 1e-9);
}

TEST(LeastVisible, IsThatOfConesOrRodsWhicheverSeeBetter) {
  EXPECT_NEAR(leastVisible(1000.0), 55.590, 1e-2);  // 10^(3 - 1.255)
  EXPECT_NEAR(leastVisible(0.1), 0.040272, 1e-5);   // 10^(-1 - 0.395)
}

TEST(HistogramAdjustment, FillsTheDisplayWithAWorldOfALargeRange) {
  const HistogramAdjustment shown(evenly(-2.0, 5.0), kTube, 10.0, 50.0);
  EXPECT_NEAR(shown(0.01), 0.5, 0.02);
  EXPECT_NEAR(shown(1e5), 100.0, 2.0);
  double previous = 0.0;
  for (double x = -3.0; x <= 6.0; x += 0.01) {
    const double now = shown(std::pow(10.0, x));
    EXPECT_GE(now, previous);
    previous = now;
  }
  EXPECT_EQ(shown(0.0), 0.0);
}

TEST(HistogramAdjustment, ShowsNothingMoreVisiblyThanItIs) {
  const HistogramAdjustment shown(evenly(-2.0, 5.0), kTube, 10.0, 50.0);
  for (double x = -1.9; x <= 4.9; x += 0.05) {
    const double world = std::pow(10.0, x);
    const double display = shown(world);
    const double ceiling = leastVisible(display) / display * world / leastVisible(world);
    // The ceiling is taken once a bin of 0.05 decades, from which it has changed a little at the other end.
    EXPECT_LE(logSlope(shown, world), 1.05 * ceiling) << world;
  }
}

TEST(HistogramAdjustment, SpendsNothingOnLuminancesThatAreNotThere) {
  std::vector<double> room;
  for (int i = 0; i < 500; ++i) room.push_back(0.05 * std::pow(40.0, i / 499.0));    // 0.05 to 2 cd/m2
  for (int i = 0; i < 500; ++i) room.push_back(2000.0 * std::pow(10.0, i / 499.0));  // a window
  const HistogramAdjustment shown(lightHistogram(room), kTube, 1.0, 50.0);
  EXPECT_NEAR(logSlope(shown, 60.0), 0.0, 1e-9);
  EXPECT_GT(logSlope(shown, 0.5), 0.1);
  EXPECT_GT(logSlope(shown, 6000.0), 0.1);
}

TEST(HistogramAdjustment, ShowsAWorldOfASmallRangeAsItIs) {
  // From 79 cd/m2 up the least visible contrast is one, in the world and on a display whose viewer is adapted
  // alike.
  const HistogramAdjustment shown(evenly(1.95, 2.3), {0.5, 1000.0}, 120.0, 120.0);
  for (const double luminance : {95.0, 120.0, 180.0})
    EXPECT_NEAR(shown(luminance), luminance, 0.01 * luminance);
  // What is outside keeps its contrast, and black is black.
  EXPECT_NEAR(shown(20.0) / shown(10.0), 2.0, 1e-6);
  // Adapted to ten times as much: a tenth of the luminance.
  const HistogramAdjustment bright(evenly(2.95, 3.3), {0.5, 1000.0}, 1200.0, 120.0);
  EXPECT_NEAR(bright(1200.0), 120.0, 2.0);
}

TEST(HistogramAdjustment, ChangesLittleWhereTheHistogramDoes) {
  // From a range that the display can show to one that it cannot, step by step.
  double previous = 0.0;
  for (double high = 1.0; high < 5.0; high += 0.005) {
    const HistogramAdjustment shown(evenly(-0.5, high), kTube, 3.0, 50.0);
    const double now = std::log10(shown(3.0));
    if (previous != 0.0) {
      EXPECT_NEAR(now, previous, 0.03) << high;
    }
    previous = now;
  }
}

TEST(HistogramAdjustment, OfNothingShowsWhatTheEyeIsAdaptedTo) {
  const HistogramAdjustment shown({}, kTube, 50.0, 50.0);
  EXPECT_NEAR(shown(50.0), 50.0, 1e-6);
  EXPECT_NEAR(shown(5.0), 5.0, 1e-6);
}

}  // namespace
}  // namespace promenade
