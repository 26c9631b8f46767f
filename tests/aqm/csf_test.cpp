#include "aqm/csf.h"

#include <gtest/gtest.h>

#include <cmath>

namespace promenade::aqm {
namespace {

void expectPublished(double found, double expected) {
  EXPECT_NEAR(found, expected, 1e-5 * expected);
}

// Published values of the formula with Daly's constants.
TEST(Sensitivity, IsDalysFormula) {
  expectPublished(sensitivity(4.0, 0.15), 237.282);
  expectPublished(sensitivity(2.0, 1.29), 232.861);
  expectPublished(sensitivity(1.0, 4.0), 175.769);
  expectPublished(sensitivity(16.0, 0.15), 26.5281);
  expectPublished(sensitivity(0.5, 10.0), 138.604);
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

struct Peak {
  double value = 0.0;
  double cyclesPerDegree = 0.0;
};

Peak peakOf(const Adaptation& adaptation) {
  Peak peak;
  for (double rho = 0.5; rho < 20.0; rho += 0.005) {
    const double s = dalySensitivity(rho, 0.0, adaptation);
    if (s > peak.value) {
      peak = {s, rho};
    }
  }
  return peak;
}

// Numbers of the published formula.
TEST(DalySensitivity, PeaksWhereDalysDoes) {
  const Peak wide = peakOf({100.0, 64.0, 0.5});
  EXPECT_NEAR(wide.value, 236.5, 0.1);
  EXPECT_NEAR(wide.cyclesPerDegree, 3.20, 0.02);
  const Peak narrow = peakOf({100.0, 1.0, 0.5});
  EXPECT_NEAR(narrow.value, 171.8, 0.1);
  EXPECT_NEAR(narrow.cyclesPerDegree, 4.71, 0.02);
  const Peak dim = peakOf({30.0, 64.0, 0.5});
  EXPECT_NEAR(dim.value, 209.7, 0.1);
  EXPECT_NEAR(dim.cyclesPerDegree, 2.86, 0.02);
}

TEST(DalySensitivity, HasTheObliqueEffect) {
  const Adaptation adaptation{100.0, 64.0, 0.5};
  const double upright = dalySensitivity(8.0, 0.0, adaptation);
  EXPECT_NEAR(dalySensitivity(8.0, std::atan(1.0), adaptation) / upright, 0.72, 0.005);
  EXPECT_NEAR(dalySensitivity(8.0, 2.0 * std::atan(1.0), adaptation), upright, 1e-9);
  EXPECT_EQ(dalySensitivity(0.0, 0.0, adaptation), 0.0);
}

// At 10 degrees from the centre of gaze the frequency axis shrinks by 1 / (1 + 2.4): 8 cycles per degree are
// seen as 27.2 there.
TEST(DalySensitivity, FallsTowardsThePeripheryAndInTheDark) {
  const Adaptation centre{100.0, 64.0, 0.5, 0.0};
  const Adaptation aside{100.0, 64.0, 0.5, 10.0};
  // i^2 goes with rho in S1, so that the area term differs; far above 1/i it does not matter.
  EXPECT_NEAR(dalySensitivity(8.0, 0.0, aside), dalySensitivity(27.2, 0.0, centre), 1e-9);
  EXPECT_LT(dalySensitivity(8.0, 0.0, {0.1, 64.0, 0.5}), 0.2 * dalySensitivity(8.0, 0.0, centre));
}

// 2.6 (0.0192 + 0.114 * 8) exp(-(0.912)^1.1) = 2.6 * 0.9312 * exp(-0.90363) = 0.98086.
TEST(MannosSakrisonSensitivity, PeaksNearEightCyclesPerDegree) {
  EXPECT_NEAR(mannosSakrisonSensitivity(8.0), 250.0 * 0.98086, 0.05);
  EXPECT_LT(mannosSakrisonSensitivity(7.0), mannosSakrisonSensitivity(8.0));
  EXPECT_LT(mannosSakrisonSensitivity(9.0), mannosSakrisonSensitivity(8.0));
  EXPECT_EQ(mannosSakrisonSensitivity(0.0), 0.0);
}

}  // namespace
}  // namespace promenade::aqm
