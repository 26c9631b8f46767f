#include "aqm/csf.h"

#include <gtest/gtest.h>

#include <cmath>

namespace promenade::aqm {
namespace {

void expectClose(double found, double expected) {
  EXPECT_NEAR(found, expected, 1e-5 * expected);
}

// Published values of the formula with Daly's constants.
TEST(Sensitivity, IsDalysFormula) {
  expectClose(sensitivity(4.0, 0.15), 237.282);
  expectClose(sensitivity(2.0, 1.29), 232.861);
  expectClose(sensitivity(1.0, 4.0), 175.769);
  expectClose(sensitivity(16.0, 0.15), 26.5281);
  expectClose(sensitivity(0.5, 10.0), 138.604);
}

TEST(Sensitivity, IsZeroForAUniformField) {
  EXPECT_EQ(sensitivity(0.0, 0.15), 0.0);
  EXPECT_EQ(sensitivity(0.0, 80.0), 0.0);
}

TEST(Sensitivity, IsTheProductOfItsParts) {
  for (const double rho : {0.1, 1.0, 7.0, 30.0}) {
    for (const double v : {0.15, 1.0, 1.7647, 12.0, 40.0}) {
      const double product = speedGain(v) * rho * rho * std::exp(-rho * frequencyDecay(v));
      EXPECT_NEAR(product, sensitivity(rho, v), 1e-12 * sensitivity(rho, v));
    }
  }
}

// The channels compute differences of decay(v) from one slope.
TEST(Sensitivity, DecaysLinearlyWithTheSpeed) {
  const double slope = frequencyDecay(1.0) - frequencyDecay(0.0);
  EXPECT_NEAR(frequencyDecay(40.0), frequencyDecay(0.0) + 40.0 * slope, 1e-12);
}

// dS/drho = 0 at rho = 2 / decay(v).
TEST(Sensitivity, PeaksAtLowerFrequenciesTheFasterTheMotion) {
  for (const double v : {0.15, 2.0, 20.0}) {
    const double peak = 2.0 / frequencyDecay(v);
    EXPECT_GT(sensitivity(peak, v), sensitivity(0.99 * peak, v));
    EXPECT_GT(sensitivity(peak, v), sensitivity(1.01 * peak, v));
  }
  EXPECT_GT(2.0 / frequencyDecay(0.15), 4.0);
  EXPECT_LT(2.0 / frequencyDecay(20.0), 0.5);
}

}  // namespace
}  // namespace promenade::aqm
