#include "src/app/forecast.h"

#include <gtest/gtest.h>

namespace promenade::app {
namespace {

TEST(Forecast, SaysTheRangeOnceAKeyframeIsMeasured) {
  Forecast walk(200, 14);
  walk.keyframeRendered(12.0);
  // 14 keyframes: 168 s; all 200: 2400 s.
  EXPECT_EQ(walk.firstEstimate(), "a keyframe takes 12s: 2m 48s to 40m 00s for all 200 frames");
  Forecast still(1, 1);
  still.keyframeRendered(0.25);
  EXPECT_EQ(still.firstEstimate(), "a keyframe takes 0.25s: 0s for the frame");
  Forecast full(10, 10);
  full.keyframeRendered(2.0);
  EXPECT_EQ(full.firstEstimate(), "a keyframe takes 2s: 20s for all 10 frames");
}

TEST(Forecast, CountsKeyframesThatWaitAsPaid) {
  Forecast walk(100, 11);
  EXPECT_FALSE(walk.secondsLeft(5.0).has_value());
  walk.keyframeRendered(4.0);
  walk.keyframeRendered(6.0);  // 5 s each
  walk.frameFinished(true);
  // 12 s have gone, 5 of them into the keyframe that waits: 7 s a frame, 99 left, one of them 5 s cheaper.
  EXPECT_DOUBLE_EQ(*walk.secondsLeft(12.0), 99 * 7.0 - 5.0);
  for (int k = 0; k < 9; ++k) walk.frameFinished(false);
  walk.frameFinished(true);
  // Nothing waits: 22 s for 11 frames, 89 left.
  EXPECT_DOUBLE_EQ(*walk.secondsLeft(22.0), 89 * 2.0);
}

TEST(Forecast, NeverPromisesLessThanNothing) {
  Forecast walk(2, 2);
  walk.keyframeRendered(10.0);
  walk.keyframeRendered(10.0);
  walk.frameFinished(true);
  EXPECT_EQ(*walk.secondsLeft(9.0), 0.0);
}

}  // namespace
}  // namespace promenade::app
