#include "aqm/filter_bank.h"

#include <gtest/gtest.h>

#include <cmath>

namespace promenade::aqm {
namespace {

constexpr int kBands = 5;

// In amplitude for Daly's filters and the pyramid, in energy for ours.
TEST(FilterBank, LosesNothingAtAnyFrequency) {
  for (const auto decomposition :
       {Decomposition::kCortexEnergy, Decomposition::kCortexAmplitude, Decomposition::kLaplacianPyramid}) {
    const double power = decomposition == Decomposition::kCortexEnergy ? 2.0 : 1.0;
    for (const int orientations : {1, 4, 6}) {
      const FilterBank filters(decomposition, kBands, orientations);
      for (double x = -0.49; x < 0.5; x += 0.07) {
        for (double y = -0.48; y < 0.5; y += 0.06) {
          const Frequency f{x, y};
          double sum = std::pow(filters.radial(f, kBands + 1), power);
          for (int band = 1; band <= kBands; ++band) {
            for (int l = 0; l < orientations; ++l) {
              sum += std::pow(filters.radial(f, band) * filters.fan(f, l), power);
            }
          }
          ASSERT_NEAR(sum, 1.0, 1e-12) << x << ", " << y;
        }
      }
    }
  }
}

// exp(-1/2 (f / sigma)^2) with sigma = (4/3) 2^-5 / 3 = 1/72: at f = 1/72, exp(-1/2).
TEST(FilterBank, HasDalysGaussianBaseband) {
  const FilterBank filters(Decomposition::kCortexAmplitude, kBands, 6);
  EXPECT_NEAR(filters.radial({1.0 / 72.0, 0.0}, kBands + 1), std::exp(-0.5), 1e-12);
  EXPECT_NEAR(filters.radial({1.0 / 72.0, 0.0}, kBands), 1.0 - std::exp(-0.5), 1e-12);
  EXPECT_EQ(filters.radial({1.0 / 24.0, 0.0}, kBands + 1), 0.0);
}

TEST(FilterBank, PassesNothingOutsideOfWhatItStates) {
  for (const auto decomposition :
       {Decomposition::kCortexEnergy, Decomposition::kCortexAmplitude, Decomposition::kLaplacianPyramid}) {
    const FilterBank filters(decomposition, kBands, 6);
    for (int band = 1; band <= kBands + 1; ++band) {
      EXPECT_GT(filters.radial({filters.centre(band), 0.0}, band), 0.3);
      for (double f = 0.0; f < 0.5; f += 0.003) {
        if (f < filters.lowest(band) || f > filters.highest(band)) {
          ASSERT_EQ(filters.radial({f, 0.0}, band), 0.0) << "band " << band << " at " << f;
        }
      }
    }
  }
}

// cos^4(pi f) (1 - cos^4(2 pi f)) near 0.14 and, scaled, half-way down the pyramid.
TEST(FilterBank, HasItsPyramidsCentresAtTheirPeaks) {
  const FilterBank filters(Decomposition::kLaplacianPyramid, kBands, 4);
  const double peak = filters.radial({filters.centre(2), 0.0}, 2);
  EXPECT_GT(peak, filters.radial({filters.centre(2) * 1.05, 0.0}, 2));
  EXPECT_GT(peak, filters.radial({filters.centre(2) * 0.95, 0.0}, 2));
  EXPECT_NEAR(filters.radial({0.36 / 32.0, 0.0}, kBands + 1), 0.5, 0.1);
}

}  // namespace
}  // namespace promenade::aqm
