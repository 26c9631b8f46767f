#include "src/core/ferwerda.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace promenade {
namespace {

constexpr double kTwoPiSquared = 2.0 * 3.141592653589793 * 3.141592653589793;

TEST(Ferwerda, ThresholdsAreThoseOfThePaper) {
  EXPECT_NEAR(coneThreshold(1e-4), std::pow(10.0, -0.72), 1e-9);
  EXPECT_NEAR(coneThreshold(1.0), 0.39130, 1e-4);   // 10^(0.65^2.7 - 0.72), 0.65^2.7 = 0.312511
  EXPECT_NEAR(coneThreshold(100.0), 5.5590, 1e-3);  // 10^(2 - 1.255)
  EXPECT_NEAR(rodThreshold(1e-5), std::pow(10.0, -2.86), 1e-9);
  EXPECT_NEAR(rodThreshold(1e-3), 1.8400e-3, 1e-6);  // 10^(0.385^2.18 - 2.86), 0.385^2.18 = 0.124826
  EXPECT_NEAR(rodThreshold(1.0), 0.40272, 1e-4);     // 10^-0.395
  // The pieces meet to within what their printed coefficients allow.
  const auto jump = [](double (*threshold)(double), double at) {
    return std::log10(threshold(std::pow(10.0, at - 1e-6)) / threshold(std::pow(10.0, at + 1e-6)));
  };
  for (const double at : {-2.6, 1.9}) EXPECT_NEAR(jump(coneThreshold, at), 0.0, 0.02);
  for (const double at : {-3.94, -1.44}) EXPECT_NEAR(jump(rodThreshold, at), 0.0, 0.02);
}

TEST(Ferwerda, RodsSeeInTheDarkAlone) {
  EXPECT_EQ(rodShare(0.001), 1.0);
  EXPECT_NEAR(rodShare(5.005), 0.25, 1e-12);  // half of the way from 0.01 to 10: (1 - 1/2)^2
  EXPECT_EQ(rodShare(10.0), 0.0);
  // D65 white, XYZ 0.95046, 1, 1.08906: 1.33 (1 + 2.08906 / 0.95046) - 1.68 = 2.5733.
  EXPECT_NEAR(scotopicLuminance(Rgb(1.0f)), 2.5733, 1e-3);
  // Red that is as bright as blue is darker in the dark (Purkinje): 1 / 0.2126 and 1 / 0.0722 of luminance 1.
  EXPECT_LT(scotopicLuminance(Rgb(4.704f, 0.0f, 0.0f)), scotopicLuminance(Rgb(0.0f, 0.0f, 13.85f)));
  EXPECT_EQ(scotopicLuminance(Rgb(0.0f)), 0.0);
}

TEST(Ferwerda, WhatIsJustVisibleToConesStaysJustVisible) {
  for (const double world : {20.0, 300.0, 1e4}) {
    const Ferwerda eye({world, world}, 50.0);
    const auto difference = static_cast<float>(coneThreshold(world));
    const auto at = static_cast<float>(world);
    EXPECT_NEAR(eye(Rgb(at + difference)).g - eye(Rgb(at)).g, coneThreshold(50.0),
                1e-3 * coneThreshold(50.0));
  }
}

TEST(Ferwerda, WhatIsJustVisibleToRodsIsJustVisibleToConesOnTheDisplay) {
  // White at 0.001 cd/m2, seen at 50 cd/m2: cones 3.08797 / 0.190546 * 0.001 = 0.016206; rods 3.08797 /
  // 0.00184003 = 1678.2 times 0.0025733: 4.3186; together 4.3348.
  const Ferwerda stars({0.001, 0.001}, 50.0);
  EXPECT_NEAR(stars(Rgb(0.001f)).g, 4.3348f, 5e-3f);
}

TEST(Ferwerda, ColoursFadeInStarlightAndStayInDaylight) {
  const Rgb red(1.0f, 0.2f, 0.2f);
  const auto saturation = [](const Rgb& c) {
    return 1.0f - std::min({c.r, c.g, c.b}) / std::max({c.r, c.g, c.b});
  };
  EXPECT_NEAR(saturation(Ferwerda({500.0, 500.0}, 50.0)(red * 500.0f)), 0.8f, 1e-5f);
  EXPECT_LT(saturation(Ferwerda({0.001, 0.001}, 50.0)(red * 0.001f)), 0.05f);
}

TEST(Ferwerda, AfterAChangeOfLightContrastIsLostButNotOverallLuminance) {
  const auto contrast = [](const Ferwerda& eye) { return eye(Rgb(12.0f)).g - eye(Rgb(10.0f)).g; };
  const Ferwerda adapted({10.0, 10.0}, 50.0);
  for (const double now : {2000.0, 0.02}) {  // out of the sun, out of the dark
    const Ferwerda late({10.0, now}, 50.0);
    EXPECT_NEAR(late(Rgb(10.0f)).g, adapted(Rgb(10.0f)).g, 1e-3f);
    EXPECT_LT(contrast(late), 0.5f * contrast(adapted));
  }
}

TEST(Acuity, IsThatOfTheFit) {
  EXPECT_NEAR(acuity(1.0), 31.528, 1e-3);    // 17.25 arctan(0.35) + 25.72, arctan 0.336675
  EXPECT_NEAR(acuity(100.0), 47.514, 1e-3);  // 17.25 arctan(3.15) + 25.72, arctan 1.263389
  EXPECT_GT(acuity(0.0), 0.0);
  EXPECT_LT(acuity(0.001), acuity(0.1));
}

TEST(Acuity, TheFinestGratingOfTheWalkerIsTheFinestOfTheViewer) {
  for (const double world : {0.001, 0.1, 5.0}) {
    const double viewer = 125.0;
    const double least = coneThreshold(viewer) / viewer;
    // The viewer's own eye brings a grating of acuity(viewer) to `least`; with the blur before it, one of
    // acuity(world).
    const double own = -std::log(least) / (kTwoPiSquared * acuity(viewer) * acuity(viewer));
    const double blur = acuityBlurDegrees(world, viewer);
    EXPECT_NEAR(std::exp(-kTwoPiSquared * (blur * blur + own) * acuity(world) * acuity(world)), least, 1e-9);
  }
  // At 0.01 cd/m2, 5.310 cycles/degree, seen at 125 cd/m2, 47.72: ln 0.05559 = -2.88974; variances 2.88974
  // / 19.7392 / 5.310^2 = 0.005192 and 0.000064: 0.005128 is the square of 0.0716.
  EXPECT_NEAR(acuityBlurDegrees(0.01, 125.0), 0.0716, 1e-4);
  EXPECT_EQ(acuityBlurDegrees(1000.0, 125.0), 0.0);
}

}  // namespace
}  // namespace promenade
