#include "aqm/masking.h"

#include <gtest/gtest.h>

#include <cmath>

#include "aqm/gaussian.h"
#include "aqm/pooling.h"

namespace promenade::aqm {
namespace {

TEST(GaussianKernel, SumsToOneAndEndsAtThreeSigma) {
  for (const double sigma : {0.1, 0.75, 1.5, 24.0, 60.0}) {
    const GaussianKernel kernel(sigma);
    EXPECT_EQ(kernel.radius(), static_cast<int>(3.0 * sigma + 0.5));
    double sum = static_cast<double>(kernel.weights()[0]);
    for (int t = 1; t <= kernel.radius(); ++t) {
      sum += 2.0 * static_cast<double>(kernel.weights()[static_cast<std::size_t>(t)]);
    }
    EXPECT_NEAR(sum, 1.0, 1e-6);
  }
  // exp(-1/2) between the centre and one sigma.
  const GaussianKernel kernel(4.0);
  EXPECT_NEAR(kernel.weights()[4] / kernel.weights()[0], std::exp(-0.5), 1e-6);
}

TEST(ExtendedRow, ContinuesAsTheBorderSays) {
  ExtendedRow reflecting(3, 4, Border::kReflect);
  ExtendedRow ending(3, 4, Border::kZero);
  for (ExtendedRow* row : {&reflecting, &ending}) {
    row->samples()[0] = 1.0f;
    row->samples()[1] = 2.0f;
    row->samples()[2] = 3.0f;
    row->extend();
  }
  const std::vector<float> reflected{3, 3, 2, 1, 1, 2, 3, 3, 2, 1, 1};
  const std::vector<float> ended{0, 0, 0, 0, 1, 2, 3, 0, 0, 0, 0};
  for (int t = 0; t <= 8; ++t) {
    for (int x = 0; x < 3; ++x) {
      EXPECT_EQ(reflecting.taps()[t][x], reflected[static_cast<std::size_t>(t + x)]);
      EXPECT_EQ(ending.taps()[t][x], ended[static_cast<std::size_t>(t + x)]);
    }
  }
}

TEST(ThresholdElevation, IsOneWithoutAMaskAndTheResponseUnderAStrongOne) {
  EXPECT_EQ(thresholdElevation(0.0), 1.0);
  // A mask at its own threshold elevates by 2^(1/4) = 1.19; Daly's constants with slope 1 would give 6.
  EXPECT_NEAR(thresholdElevation(1.0), 1.189207, 1e-6);
  EXPECT_NEAR(thresholdElevation(-1.0), 1.189207, 1e-6);
  EXPECT_NEAR(thresholdElevation(100.0), 100.0, 1e-5);
}

Responses responsesOf(Size size, float test, float reference) {
  Responses responses{Plane<float>(size.width, size.height), Plane<float>(size.width, size.height)};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      responses.test.row(y)[x] = test;
      responses.reference.row(y)[x] = reference;
    }
  }
  return responses;
}

// The low-pass of a uniform elevation is that elevation, to the border and on any size.
TEST(DifferenceSum, DividesByTheLesserElevation) {
  for (const Size size : {Size{1, 1}, Size{1, 9}, Size{9, 1}, Size{41, 17}}) {
    DifferenceSum sum(size, 6, Masking{});
    sum.add(responsesOf(size, 3.0f, -2.0f), 4);
    sum.add(responsesOf(size, 0.5f, 0.0f), 1);
    const double expected = std::pow(5.0 / thresholdElevation(2.0), 3.5) + std::pow(0.5, 3.5);
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        ASSERT_NEAR(sum.powers().row(y)[x], expected, 1e-5 * expected) << x << ", " << y;
      }
    }
  }
}

// k1 (k2 m)^s at m = 2: 0.0153 * 785 = 12.01 with slope 1; 0.0153 * 785^0.7 = 0.0153 * 106.27 = 1.6260 with
// 0.7; 0.0153 * 785^0.8 = 0.0153 * 206.98 = 3.1668 with 0.8. T = (1 + that^4)^(1/4).
TEST(ThresholdElevation, OfDalyHasALowerSlopeAtLowFrequencies) {
  EXPECT_NEAR(thresholdElevation(2.0, Elevation::kDaly, dalySlope(1, 6)), 12.0107, 2e-3);
  EXPECT_NEAR(thresholdElevation(-2.0, Elevation::kDaly, dalySlope(5, 6)), 12.0107, 2e-3);
  EXPECT_NEAR(thresholdElevation(2.0, Elevation::kDaly, dalySlope(6, 6)), 3.1746, 2e-3);
  EXPECT_NEAR(thresholdElevation(2.0, Elevation::kDaly, dalySlope(7, 6)), 1.6813, 2e-3);
  EXPECT_EQ(thresholdElevation(5.0, Elevation::kNone), 1.0);
}

TEST(DifferenceSum, IsElevatedByTheFrameThatIsTheMask) {
  const Size size{9, 4};
  const auto powerWith = [&](Elevation elevation, MaskSource source, int band) {
    DifferenceSum sum(size, 6, Masking{elevation, MaskExtent::kChannel, source});
    sum.add(responsesOf(size, 3.0f, 1.0f), band);
    return static_cast<double>(sum.powers().row(2)[5]);
  };
  const auto expected = [](double elevation) { return std::pow(2.0 / elevation, 3.5); };
  for (const auto& [elevation, band] : {std::pair(Elevation::kUnitKnee, 2), std::pair(Elevation::kDaly, 7)}) {
    const double test = expected(thresholdElevation(3.0, elevation, dalySlope(band, 6)));
    const double reference = expected(thresholdElevation(1.0, elevation, dalySlope(band, 6)));
    EXPECT_NEAR(powerWith(elevation, MaskSource::kTest, band), test, 1e-5 * test);
    EXPECT_NEAR(powerWith(elevation, MaskSource::kReference, band), reference, 1e-5 * reference);
    EXPECT_NEAR(powerWith(elevation, MaskSource::kMutual, band), reference, 1e-5 * reference);
  }
  EXPECT_NEAR(powerWith(Elevation::kNone, MaskSource::kMutual, 3), expected(1.0), 1e-5 * expected(1.0));
}

// T(2 m) instead of T(m).
TEST(DifferenceSum, IsElevatedMoreByAStrongerMasking) {
  DifferenceSum sum({9, 4}, 6, Masking{.strength = 2.0});
  sum.add(responsesOf({9, 4}, 3.0f, 1.0f), 2);
  const double expected = std::pow(2.0 / thresholdElevation(2.0), 3.5);
  EXPECT_NEAR(sum.powers().row(2)[5], expected, 1e-5 * expected);
}

TEST(DifferenceSum, OfAPointDoesNotSpreadItsElevation) {
  const Size size{31, 3};
  Responses responses = responsesOf(size, 1.0f, 0.0f);
  responses.reference.row(1)[15] = 10.0f;
  DifferenceSum sum(size, 6, Masking{Elevation::kUnitKnee, MaskExtent::kPoint, MaskSource::kReference});
  sum.add(responses, 3);
  EXPECT_FLOAT_EQ(sum.powers().row(1)[14], 1.0f);
  EXPECT_FLOAT_EQ(sum.powers().row(0)[15], 1.0f);
  const double there = std::pow(9.0 / thresholdElevation(10.0), 3.5);
  EXPECT_NEAR(sum.powers().row(1)[15], there, 1e-5 * there);
}

TEST(DifferenceSum, KeepsTheSignOfTheChangeIfAsked) {
  DifferenceSum sum({5, 2}, 6, Masking{}, SignedMap::kYes);
  sum.add(responsesOf({5, 2}, 1.0f, 3.0f), 3);
  sum.add(responsesOf({5, 2}, 0.5f, 0.0f), 4);
  EXPECT_EQ(sum.changes().row(1)[4], -1.5f);
  EXPECT_EQ(DifferenceSum({5, 2}, 6, Masking{}).changes().width(), 0);
}

// sigma = 0.375 * 2^3 = 3 pixels, so a lone response of 10 at the centre elevates a neighbour d pixels away
// by w0 w_d (T(10) - 1).
TEST(DifferenceSum, SpreadsTheElevationOverTheChannelsExtent) {
  const Size size{31, 31};
  Responses responses = responsesOf(size, 1.0f, 0.0f);
  responses.test.row(15)[15] = 10.0f;
  responses.reference.row(15)[15] = 10.0f;
  DifferenceSum sum(size, 6, Masking{});
  sum.add(responses, 3);
  const GaussianKernel kernel(3.0);
  const double weight = static_cast<double>(kernel.weights()[0]) * static_cast<double>(kernel.weights()[4]);
  // The reference, uniform 0 but for the centre, is the less elevated of the two.
  const double elevation = 1.0 + weight * (thresholdElevation(10.0) - 1.0);
  EXPECT_NEAR(sum.powers().row(15)[19], std::pow(1.0 / elevation, 3.5), 1e-5);
  EXPECT_NEAR(sum.powers().row(19)[15], std::pow(1.0 / elevation, 3.5), 1e-5);
  EXPECT_NEAR(sum.powers().row(0)[0], 1.0, 1e-5);  // out of reach: radius 9
  EXPECT_EQ(sum.powers().row(15)[15], 0.0f);       // no difference
}

TEST(DifferenceSum, IsZeroWhereTheResponsesAreEqual) {
  DifferenceSum sum({20, 3}, 6, Masking{});
  sum.add(responsesOf({20, 3}, 123.456f, 123.456f), 6);
  for (int x = 0; x < 20; ++x) {
    EXPECT_EQ(sum.powers().row(1)[x], 0.0f);
  }
}

Plane<float> uniformPowers(Size size, float value) {
  Plane<float> powers(size.width, size.height);
  for (int y = 0; y < size.height; ++y) {
    std::fill_n(powers.row(y), size.width, value);
  }
  return powers;
}

// 2 pi 0.5^2 = 1.5708 square degrees under the window, half of them at an edge, a quarter in a corner.
TEST(Pooling, IntegratesOverTheWindowWithNothingBeyondTheImage) {
  const Plane<float> pooled = pooledPowers(uniformPowers({80, 80}, 2.0f), 10.0);  // sigma 5, radius 15
  EXPECT_NEAR(pooled.row(40)[40], 2.0 * 1.5708, 1e-4);
  const GaussianKernel kernel(5.0);
  const double half =
      0.5 * (1.0 + static_cast<double>(kernel.weights()[0]));  // the edge pixel itself counts in full
  EXPECT_NEAR(pooled.row(0)[40], half * 2.0 * 1.5708, 1e-4);
  EXPECT_NEAR(pooled.row(40)[79], half * 2.0 * 1.5708, 1e-4);
  EXPECT_NEAR(pooled.row(79)[0], half * half * 2.0 * 1.5708, 1e-4);
}

TEST(Pooling, OfASinglePixelIsItsShareOfTheWindow) {
  const Plane<float> pooled = pooledPowers(uniformPowers({1, 1}, 1.0f), 10.0);
  const double centre = static_cast<double>(GaussianKernel(5.0).weights()[0]);
  EXPECT_NEAR(pooled.row(0)[0], 1.5708 * centre * centre, 1e-6);
}

TEST(Pooling, ThresholdIsWhereThePooledJndIsOne) {
  Plane<float> pooled(4, 1);
  pooled.row(0)[1] = 1.0f;
  pooled.row(0)[2] = std::pow(1.0978f, 3.5f);
  pooled.row(0)[3] = 1e30f;
  const ProbabilityMap probability = detectionProbability(pooled);
  EXPECT_EQ(probability(0, 0), 0.0f);
  EXPECT_NEAR(probability(1, 0), 1.0 - std::exp(-1.0), 1e-6);
  EXPECT_NEAR(probability(2, 0), 0.75, 1e-4);
  EXPECT_EQ(probability(3, 0), 1.0f);
  EXPECT_NEAR(pooledJnd(pooled)(2, 0), 1.0978, 1e-5);
  EXPECT_NEAR(sharpJnd(pooled)(2, 0), 1.0978, 1e-5);
  EXPECT_EQ(sharpJnd(pooled)(0, 0), 0.0f);
}

}  // namespace
}  // namespace promenade::aqm
