#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "src/core/tone_curves.h"
#include "src/core/tumblin_rushmeier.h"
#include "src/core/ward.h"

namespace promenade {
namespace {

TEST(TumblinRushmeier, HasTheExponentsOfThePaper) {
  // The paper's unit: 1 lambert is 10^4 / pi cd/m2, where its logarithm is 0.
  const double lambert = 1e4 / 3.141592653589793;
  EXPECT_NEAR(stevensAlpha(lambert), 2.92, 1e-9);
  EXPECT_NEAR(stevensBeta(lambert), 2.0208, 1e-9);
  EXPECT_NEAR(stevensAlpha(lambert / 100.0), 2.12, 1e-9);   // 0.4 * -2 + 2.92
  EXPECT_NEAR(stevensBeta(lambert / 100.0), 5.5888, 1e-9);  // -0.4 * 4 + 2.584 * 2 + 2.0208
  // In cd/m2, x = log10 L: alpha = 0.4 x + 1.519, as the course notes have it; beta = -0.4 x^2 + 0.2183 x
  // + 6.1642, where they have the other sign of the middle term.
  for (const double x : {-1.0, 0.0, 2.0, 4.0}) {
    EXPECT_NEAR(stevensAlpha(std::pow(10.0, x)), 0.4 * x + 1.519, 2e-4);
    EXPECT_NEAR(stevensBeta(std::pow(10.0, x)), -0.4 * x * x + 0.2183 * x + 6.1642, 1e-3);
  }
}

TEST(TumblinRushmeier, ChangesNothingForAnEyeThatIsAdaptedAlike) {
  const TumblinRushmeier alike(50.0, 50.0);
  for (const double luminance : {0.0, 0.1, 7.0, 50.0, 300.0})
    EXPECT_NEAR(alike(luminance), luminance, 1e-9 * luminance);
}

TEST(TumblinRushmeier, IsTheNumberThatTheFormulaGives) {
  // World 100: l = 2 - 3.502850 = -1.502850; alpha = 2.318860, beta = -0.903423 + 3.883365 + 2.0208
  // = 5.000742. Display 50 (log10 1.698970): l = -1.803880; alpha = 2.198448, beta = -1.301593 + 4.661226
  // + 2.0208 = 5.380433. 100 cd/m2 is 10^-1.502850 lambert: the logarithm of Ld in lamberts is (5.000742
  // - 5.380433) / 2.198448 - 1.502850 * 2.318860 / 2.198448 = -0.172709 - 1.585163 = -1.757872;
  // plus 3.502850: 1.744978, 55.587 cd/m2.
  EXPECT_NEAR(TumblinRushmeier(100.0, 50.0)(100.0), 55.587, 2e-3);
}

TEST(TumblinRushmeier, MakesBrightnessesEqual) {
  for (const double world : {0.05, 3.0, 2000.0}) {
    const TumblinRushmeier shown(world, 125.0);
    for (const double luminance : {0.2 * world, world, 7.0 * world}) {
      const auto brightness = [](double l, double adaptation) {
        return stevensBeta(adaptation) + stevensAlpha(adaptation) * std::log10(3.141592653589793e-4 * l);
      };
      EXPECT_NEAR(brightness(luminance, world), brightness(shown(luminance), 125.0), 1e-9);
    }
  }
}

TEST(TumblinRushmeier, ShowsADarkWorldDarkerAndABrightOneBrighter) {
  // What the eye is adapted to, in the light of a candle, a room, the sun.
  const auto shown = [](double luminance) { return TumblinRushmeier(luminance, 50.0)(luminance); };
  EXPECT_LT(shown(0.1), shown(50.0));
  EXPECT_LT(shown(50.0), shown(5000.0));
}

TEST(Ward, ThresholdIsTheNumberThatTheFormulaGives) {
  // 0.0594 (1.219 + 1)^2.5 = 0.0594 * 7.334944 = 0.435696.
  EXPECT_NEAR(wardThreshold(1.0), 0.435696, 1e-5);
  EXPECT_NEAR(wardThreshold(0.0), 0.0594 * std::pow(1.219, 2.5), 1e-12);
}

TEST(Ward, WhatIsJustVisibleStaysJustVisible) {
  EXPECT_NEAR(wardScale(50.0, 50.0), 1.0, 1e-12);
  for (const double world : {0.001, 1.0, 300.0, 1e5}) {
    EXPECT_NEAR(wardScale(world, 50.0) * wardThreshold(world), wardThreshold(50.0), 1e-12);
  }
  // 50^0.4 = 4.78176, 1000^0.4 = 15.84893: (6.00076 / 17.06793)^2.5 = 0.0732932.
  EXPECT_NEAR(wardScale(1000.0, 50.0), 0.0732932, 2e-6);
}

TEST(Schlick, IsRationalFromBlackToWhite) {
  EXPECT_EQ(schlickCurve(0.0, 10.0), 0.0);
  EXPECT_EQ(schlickCurve(1.0, 10.0), 1.0);
  EXPECT_NEAR(schlickCurve(0.5, 10.0), 5.0 / 5.5, 1e-12);
  EXPECT_NEAR(schlickCurve(1e-6, 10.0) / 1e-6, 10.0, 1e-3);  // the slope at black
}

TEST(Schlick, KeepsMiddleGreyAndHue) {
  EXPECT_NEAR(schlick(Rgb(0.18f)).g, 0.18f, 1e-6f);
  EXPECT_NEAR(schlick(Rgb(16.0f)).g, 1.0f, 1e-6f);
  EXPECT_NEAR(schlick(Rgb(99.0f)).g, 1.0f, 1e-6f);
  const Rgb colour = schlick(Rgb(0.5f, 0.25f, 0.125f));
  EXPECT_NEAR(colour.r / colour.g, 2.0f, 1e-5f);
  EXPECT_NEAR(colour.g / colour.b, 2.0f, 1e-5f);
}

TEST(Agx, KeepsGreyGreyAndRunsToWhite) {
  EXPECT_EQ(agxCurve(Rgb(0.0f)), Rgb(0.0f));
  // log2 0.18 = -2.47393: x = 10 / 16.5 = 0.606061, curve 0.49659, to the power of 2.2: 0.2145.
  const Rgb grey = agxCurve(Rgb(0.18f));
  EXPECT_NEAR(grey.g, 0.2145f, 1e-3f);
  EXPECT_NEAR(grey.r, grey.b, 1e-3f);
  EXPECT_GT(agxCurve(Rgb(20.0f)).g, 0.99f);
  const Rgb bright = agxCurve(Rgb(100.0f, 1.0f, 1.0f));  // a saturated light does not stay red
  EXPECT_GT(bright.g, 0.5f);
}

}  // namespace
}  // namespace promenade
