#include "src/walkthrough/switch_over.h"

#include <gtest/gtest.h>

namespace promenade::walkthrough {
namespace {

TEST(SwitchOver, LooksAtTheErrorAfterATenthOfTheFirstComputedPictureAndHalfASecondAtLeast) {
  EXPECT_DOUBLE_EQ(SwitchOver().samplingSeconds(20.0), 2.0);
  EXPECT_DOUBLE_EQ(SwitchOver().samplingSeconds(5.0), 0.5);
  EXPECT_DOUBLE_EQ(SwitchOver().samplingSeconds(1.0), 0.5);
}

TEST(SwitchOver, ComesWhenTheErrorIsExpectedToBeFifteenPerCent) {
  // After 2 s the error is 0.3; half of it takes four times as long.
  EXPECT_NEAR(SwitchOver().seconds(2.0, 0.30, 20.0), 8.0, 1e-12);
  EXPECT_NEAR(SwitchOver().seconds(2.0, 0.15, 20.0), 2.0, 1e-12);
  // It has come already: 2 * (0.05 / 0.15)^2.
  EXPECT_NEAR(SwitchOver().seconds(2.0, 0.05, 20.0), 2.0 / 9.0, 1e-12);
}

TEST(SwitchOver, IsNoLaterThanAComputedPictureWouldTake) {
  // 2 * 4^2 = 32.
  EXPECT_DOUBLE_EQ(SwitchOver().seconds(2.0, 0.60, 20.0), 20.0);
}

}  // namespace
}  // namespace promenade::walkthrough
