#include "ibr/subpixel_offsets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <set>

namespace promenade::ibr {
namespace {

/// Offsets are multiples of 1 / period.
int phase(double offset, int period) {
  return ((static_cast<int>(std::lround(offset * period)) % period) + period) % period;
}

TEST(SubpixelOffset, StaysWithinTheCellOfTheSample) {
  for (const int period : {1, 3, 5, 7, 33}) {
    for (int frame = -5; frame < 70; ++frame) {
      const glm::dvec2 offset = subpixelOffset(frame, period);
      EXPECT_LT(std::abs(offset.x), 0.5);
      EXPECT_LT(std::abs(offset.y), 0.5);
    }
  }
}

TEST(SubpixelOffset, OfAnyFramesOfAPeriodDiffersInBothDirections) {
  for (const int period : {3, 5, 7, 9}) {
    for (int first = -4; first < 4; ++first) {
      std::set<int> x;
      std::set<int> y;
      for (int frame = first; frame < first + period; ++frame) {
        x.insert(phase(subpixelOffset(frame, period).x, period));
        y.insert(phase(subpixelOffset(frame, period).y, period));
      }
      EXPECT_EQ(static_cast<int>(x.size()), period);
      EXPECT_EQ(static_cast<int>(y.size()), period);
    }
  }
}

TEST(SubpixelOffset, PointsOfAPeriodAreSpreadOverTheCell) {
  // Of 5 points with 5 different x and y, none can be farther apart on a torus than a knight's move: sqrt(5)
  // / 5.
  for (int i = 0; i < 5; ++i) {
    for (int k = 0; k < i; ++k) {
      glm::dvec2 apart = glm::abs(subpixelOffset(i, 5) - subpixelOffset(k, 5));
      apart = glm::min(apart, 1.0 - apart);
      EXPECT_NEAR(glm::length(apart), std::sqrt(5.0) / 5.0, 1e-12);
    }
  }
}

TEST(SubpixelOffset, IsUndoneByNoMotion) {
  // Something that moves by m / 5 samples a frame: with steps of one size its samples would all fall together
  // for one m.
  for (int m = 0; m < 5; ++m) {
    std::set<int> x;
    for (int frame = 0; frame < 5; ++frame) x.insert((phase(subpixelOffset(frame, 5).x, 5) + m * frame) % 5);
    EXPECT_GE(x.size(), 3u) << m;
  }
}

}  // namespace
}  // namespace promenade::ibr
