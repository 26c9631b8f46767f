#include "aqm/cortex.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "aqm/layout.h"

namespace promenade::aqm {
namespace {

constexpr int kPublishedBands = 5;

// Published values, absolute tolerance 2e-5.
TEST(BandAmplitude, HasThePublishedValues) {
  const std::array<double, 5> frequencies{.03, .09, .2, .4, .65};
  const std::array<std::array<double, 5>, 6> expected{{{0, 0, 0, .30902, .99692},
                                                       {0, 0, .30902, .95106, .07846},
                                                       {0, .12533, .95106, 0, 0},
                                                       {0, .99211, 0, 0, 0},
                                                       {.63742, 0, 0, 0, 0},
                                                       {.77051, 0, 0, 0, 0}}};
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    for (int band = 1; band <= kPublishedBands; ++band) {
      EXPECT_NEAR(bandAmplitude(frequencies[i], band), expected[static_cast<std::size_t>(band - 1)][i], 2e-5)
          << "band " << band << " at " << frequencies[i];
    }
    EXPECT_NEAR(basebandAmplitude(frequencies[i], kPublishedBands), expected[5][i], 2e-5);
  }
}

TEST(FanAmplitude, HasThePublishedValues) {
  const std::array<double, 4> degrees{10, 45, 100, 170};
  const std::array<std::array<double, 6>, 4> expected{{{.86603, .5, 0, 0, 0, 0},
                                                       {0, .70711, .70711, 0, 0, 0},
                                                       {0, 0, 0, .86603, .5, 0},
                                                       {.86603, 0, 0, 0, 0, .5}}};
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    const double angle = degrees[i] * std::numbers::pi / 180.0;
    for (int l = 0; l < kOrientations; ++l) {
      EXPECT_NEAR(fanAmplitude({0.2 * std::cos(angle), 0.2 * std::sin(angle)}, l),
                  expected[i][static_cast<std::size_t>(l)], 2e-5)
          << "orientation " << l << " at " << degrees[i];
    }
  }
}

TEST(Mesa, HasHalfItsHeightAtItsNameAndATransitionOfTwoThirdsOfIt) {
  EXPECT_EQ(mesa(0.0, 0.25), 1.0);
  EXPECT_NEAR(mesa(0.25 * 2.0 / 3.0, 0.25), 1.0, 1e-15);
  EXPECT_NEAR(mesa(0.25, 0.25), 0.5, 1e-15);
  EXPECT_NEAR(mesa(0.25 * 4.0 / 3.0, 0.25), 0.0, 1e-15);
  EXPECT_EQ(mesa(0.5, 0.25), 0.0);
}

Frequency frequencyOf(int ix, int iy, Size size) {
  return {signedFrequency(ix, size.width), signedFrequency(iy, size.height), 2 * ix == size.width,
          2 * iy == size.height};
}

// At 45 degrees from the axis of a fan of 4, whose half-width at zero is 45 degrees: 0; at 22.5: cos(4
// * 22.5) = 0, so one half, shared with its neighbour. Of 2: 1/2 (1 + cos 90) = one half at 45 degrees.
TEST(FanAmplitude, OfAnyNumberOfOrientationsHasSquaresThatSumToOne) {
  const auto squared = [](double degrees, int l, int n) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const double a = fanAmplitude({0.2 * std::cos(angle), 0.2 * std::sin(angle)}, l, n);
    return a * a;
  };
  EXPECT_NEAR(squared(45.0, 0, 4), 0.0, 1e-12);
  EXPECT_NEAR(squared(22.5, 0, 4), 0.5, 1e-12);
  EXPECT_NEAR(squared(22.5, 1, 4), 0.5, 1e-12);
  EXPECT_NEAR(squared(45.0, 1, 2), 0.5, 1e-12);
  EXPECT_EQ(squared(77.0, 0, 1), 1.0);
  for (const int n : {1, 2, 3, 4, 5, 6, 8, 12}) {
    for (double degrees = 0.0; degrees < 360.0; degrees += 7.0) {
      double sum = 0.0;
      for (int l = 0; l < n; ++l) {
        sum += squared(degrees, l, n);
      }
      ASSERT_NEAR(sum, 1.0, 1e-12) << n << " at " << degrees;
    }
  }
}

TEST(AcrossBars, IsExactOnTheAxesAndMirrored) {
  EXPECT_EQ(acrossBars(0), glm::dvec2(1.0, 0.0));
  EXPECT_EQ(acrossBars(3), glm::dvec2(0.0, 1.0));
  EXPECT_EQ(acrossBars(2, 4), glm::dvec2(0.0, 1.0));
  EXPECT_EQ(acrossBars(5).x, -acrossBars(1).x);
  EXPECT_EQ(acrossBars(5).y, acrossBars(1).y);
  EXPECT_NEAR(acrossBars(1, 4).x, std::sqrt(0.5), 1e-15);
}

double squaredFilter(int ix, int iy, Size size, int band, int orientation) {
  const Frequency f = frequencyOf(ix, iy, size);
  const double amplitude = bandAmplitude(std::hypot(f.x, f.y), band) * fanAmplitude(f, orientation);
  return amplitude * amplitude;
}

TEST(CortexFilters, HaveSquaresThatSumToOneAtEveryFrequency) {
  for (const Size size : {Size{60, 48}, Size{45, 27}, Size{1, 1}}) {
    for (int iy = 0; iy < size.height; ++iy) {
      for (int ix = 0; ix < size.width; ++ix) {
        const double base = basebandAmplitude(
            std::hypot(signedFrequency(ix, size.width), signedFrequency(iy, size.height)), kPublishedBands);
        double sum = base * base;
        for (int band = 1; band <= kPublishedBands; ++band) {
          for (int l = 0; l < kOrientations; ++l) {
            sum += squaredFilter(ix, iy, size, band, l);
          }
        }
        ASSERT_NEAR(sum, 1.0, 1e-14) << ix << ", " << iy;
      }
    }
  }
}

// H(f) = H(-f), modulo the sampling frequency: otherwise a filtered real image is not real.
TEST(CortexFilters, AreHermitianAlsoAtNyquistsFrequency) {
  const Size size{60, 48};
  for (int iy = 0; iy < size.height; ++iy) {
    for (int ix = 0; ix < size.width; ++ix) {
      const int mirroredX = (size.width - ix) % size.width;
      const int mirroredY = (size.height - iy) % size.height;
      for (int l = 0; l < kOrientations; ++l) {
        ASSERT_NEAR(squaredFilter(ix, iy, size, 1, l), squaredFilter(mirroredX, mirroredY, size, 1, l), 1e-15)
            << ix << ", " << iy << " in orientation " << l;
      }
    }
  }
}

TEST(CortexFilters, PassOnlyTheirOctaves) {
  for (int band = 1; band <= kPublishedBands; ++band) {
    const double unit = std::ldexp(1.0, -band);
    EXPECT_EQ(bandAmplitude(0.66 * unit, band), 0.0);
    EXPECT_GT(bandAmplitude(0.68 * unit, band), 0.0);
    EXPECT_NEAR(bandAmplitude(bandCentre(band), band), 1.0, 1e-15);
    if (band > 1) {
      EXPECT_GT(bandAmplitude(2.66 * unit, band), 0.0);
      EXPECT_EQ(bandAmplitude(2.67 * unit, band), 0.0);
    }
  }
  EXPECT_EQ(basebandCentre(5), 1.0 / 64.0);
}

TEST(SignedFrequency, IsNumberedLikeADiscreteFourierTransform) {
  EXPECT_EQ(signedFrequency(0, 4), 0.0);
  EXPECT_EQ(signedFrequency(1, 4), 0.25);
  EXPECT_EQ(signedFrequency(2, 4), -0.5);
  EXPECT_EQ(signedFrequency(3, 4), -0.25);
  EXPECT_EQ(signedFrequency(2, 5), 0.4);
  EXPECT_EQ(signedFrequency(3, 5), -0.4);
  EXPECT_EQ(signedFrequency(0, 1), 0.0);
}

}  // namespace
}  // namespace promenade::aqm
