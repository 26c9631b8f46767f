#include "aqm/contrast.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/aqm/patterns.h"

namespace promenade::aqm {
namespace {

using tests::frameOf;

// 30 / (30 + 12.6 * 30^0.63) = 0.218359. C(27) and C(33) follow from R(27) and R(33) and Lm R'(Lm) = 0.37 *
// 0.218359 * 0.781641.
TEST(Contrast, OfTwoPatchesTenPerCentDarkerAndBrighterThanTheMean) {
  const LuminanceMap patches = frameOf({4, 4}, [](int x, int) { return x < 2 ? 27.0 : 33.0; });
  const double adaptation = adaptationLuminance(patches, patches);
  EXPECT_DOUBLE_EQ(adaptation, 30.0);
  EXPECT_NEAR(coneResponse(30.0), 0.218359, 1e-6);
  const ContrastMap map = contrast(patches, adaptation);
  EXPECT_NEAR(map(0, 3), -0.104203, 1e-6);
  EXPECT_NEAR(map(3, 0), 0.0962562, 1e-7);
}

TEST(Contrast, OfASmallChangeIsTheWeberContrast) {
  const ContrastMap map = contrast(LuminanceMap(1, 1, 100.01f), 100.0);
  // The second-order term is of relative size 1e-4.
  EXPECT_NEAR(map(0, 0), 1e-4, 2e-8);
}

TEST(Contrast, AdaptsToTheMeanOfBothFrames) {
  EXPECT_DOUBLE_EQ(adaptationLuminance(LuminanceMap(3, 2, 10.0f), LuminanceMap(3, 2, 30.0f)), 20.0);
  const LuminanceMap a = frameOf({17, 5}, [](int x, int y) { return 0.1 + x * 0.3 + y; });
  const LuminanceMap b = frameOf({17, 5}, [](int x, int y) { return 70.1 - x - y; });
  EXPECT_EQ(adaptationLuminance(a, b), adaptationLuminance(b, a));
}

TEST(Contrast, IsFiniteForAnyLuminance) {
  EXPECT_GT(coneResponse(1e-38), 0.0);
  EXPECT_LT(coneResponse(1e-38), 1e-14);
  EXPECT_GT(coneResponse(1e38), 0.99);
  EXPECT_LE(coneResponse(1e38), 1.0);
  const LuminanceMap both = frameOf({2, 1}, [](int x, int) { return x == 0 ? 1e-38 : 3e38; });
  const ContrastMap map = contrast(both, adaptationLuminance(both, both));
  EXPECT_TRUE(std::isfinite(map(0, 0)));
  EXPECT_TRUE(std::isfinite(map(1, 0)));
}

}  // namespace
}  // namespace promenade::aqm
