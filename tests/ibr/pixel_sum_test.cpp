#include "ibr/pixel_sum.h"

#include <gtest/gtest.h>

namespace promenade::ibr {
namespace {

TEST(PixelSum, OfSamplesThatAgreeIsTheirValueWhereverTheyLie) {
  PixelSum sum(4);
  sum.addWhole(1.0f);
  sum.add({0.0f, 0.0f}, Rgb(0.7f), 0.25f, Seen::kClearly);
  sum.add({0.99f, 0.4f}, Rgb(0.7f), 0.25f, Seen::kClearly);
  EXPECT_NEAR(sum.mean().g, 0.7f, 1e-6f);
}

TEST(PixelSum, WithoutSamplesIsBlack) {
  PixelSum sum(2);
  sum.addWhole(1.0f);
  EXPECT_EQ(sum.mean(), Rgb(0.0f));
}

TEST(PixelSum, CountsSamplesThatLieTogetherForThePlaceTheyLieIn) {
  // Nine samples of 1 in the left half, one of 0 in the right: the halves count alike.
  PixelSum sum(2);
  sum.addWhole(2.0f);
  for (int i = 0; i < 9; ++i) sum.add({0.25f, i < 5 ? 0.25f : 0.75f}, Rgb(1.0f), 0.2f, Seen::kClearly);
  sum.add({0.75f, 0.5f}, Rgb(0.0f), 0.5f, Seen::kClearly);
  EXPECT_NEAR(sum.mean().r, 0.5f, 1e-6f);
}

TEST(PixelSum, LeavesToSamplesAtAnEdgeWhatTheOthersDoNotCover) {
  // A quarter of the pixel is covered for certain; three quarters are left for samples whose areas add up to
  // one and a half: the edge hides half of them.
  PixelSum sum(1);
  sum.addWhole(1.0f);
  sum.add({0.2f, 0.5f}, Rgb(1.0f), 0.25f, Seen::kClearly);
  sum.add({0.6f, 0.5f}, Rgb(0.0f), 0.75f, Seen::kPerhaps);
  sum.add({0.8f, 0.5f}, Rgb(0.0f), 0.75f, Seen::kPerhaps);
  EXPECT_NEAR(sum.mean().r, 0.25f, 1e-6f);
}

TEST(PixelSum, LeavesNothingToSamplesAtAnEdgeWhereAllIsCovered) {
  PixelSum sum(1);
  sum.addWhole(1.0f);
  sum.add({0.2f, 0.5f}, Rgb(1.0f), 1.0f, Seen::kClearly);
  sum.add({0.6f, 0.5f}, Rgb(0.0f), 0.75f, Seen::kPerhaps);
  EXPECT_EQ(sum.mean().r, 1.0f);
}

}  // namespace
}  // namespace promenade::ibr
