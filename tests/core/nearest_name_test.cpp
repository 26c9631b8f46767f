#include "src/core/nearest_name.h"

#include <gtest/gtest.h>

#include <array>

namespace promenade {
namespace {

TEST(EditDistance, CountsInsertionsDeletionsSubstitutionsAndSwaps) {
  EXPECT_EQ(editDistance("size", "size"), 0);
  EXPECT_EQ(editDistance("sze", "size"), 1);        // i inserted
  EXPECT_EQ(editDistance("siize", "size"), 1);      // i deleted
  EXPECT_EQ(editDistance("sine", "size"), 1);       // n for z
  EXPECT_EQ(editDistance("szie", "size"), 1);       // two letters swapped
  EXPECT_EQ(editDistance("kitten", "sitting"), 3);  // k-s, e-i, +g
  EXPECT_EQ(editDistance("", "fps"), 3);
  EXPECT_EQ(editDistance("FPS", "fps"), 0);
}

TEST(NearestName, PicksTheSmallestDistanceAndTheFirstOfEquals) {
  constexpr std::array<std::string_view, 3> kNames = {"target", "time", "eye"};
  EXPECT_EQ(nearestName("traget", kNames), "target");
  EXPECT_EQ(nearestName("times", kNames), "time");
  EXPECT_EQ(nearestName("", std::array<std::string_view, 2>{"ab", "cd"}), "ab");
  EXPECT_EQ(nearestName("x", {}), "");
}

}  // namespace
}  // namespace promenade
