#include "ibr/pixel_sum.h"

#include <gtest/gtest.h>

namespace promenade::ibr {
namespace {

TEST(PixelSum, OfSamplesThatAgreeIsTheirValueWhereverTheyLie) {
  PixelSum sum(4);
  sum.addWhole(1.0f);
  sum.add({0.0f, 0.0f}, Rgb(0.7f), 0.25f);
  sum.add({0.99f, 0.4f}, Rgb(0.7f), 0.25f);
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
  for (int i = 0; i < 9; ++i) sum.add({0.25f, i < 5 ? 0.25f : 0.75f}, Rgb(1.0f), 0.2f);
  sum.add({0.75f, 0.5f}, Rgb(0.0f), 0.5f);
  EXPECT_NEAR(sum.mean().r, 0.5f, 1e-6f);
}

TEST(PixelSum, OfARampIsNearItsMiddleThoughSamplesLieToOneSide) {
  // v = 1 + x - y / 2, which is 1.25 in the middle. The samples' own mean is 1.125, since they lie 0.125 to
  // the left. Places differ by 0.25 from their mean along each edge, so the ridge of 0.01 leaves 0.0625 /
  // 0.0725 = 0.862 of the slope, which explains as much of the variance: 0.862^2 of what the mean lacks.
  PixelSum sum(4);
  sum.addWhole(1.0f);
  for (const glm::vec2 place : {glm::vec2(0.125f, 0.25f), glm::vec2(0.625f, 0.25f), glm::vec2(0.125f, 0.75f),
                                glm::vec2(0.625f, 0.75f)}) {
    sum.add(place, Rgb(1.0f + place.x - 0.5f * place.y), 0.25f);
  }
  EXPECT_NEAR(sum.mean().r, 1.125f + 0.862f * 0.862f * 0.125f, 1e-3f);
}

TEST(PixelSum, StaysWithinWhatItsSamplesHave) {
  // Steep and in one corner: the plane would be far below 0 in the middle.
  PixelSum sum(4);
  sum.addWhole(1.0f);
  sum.add({0.05f, 0.05f}, Rgb(1.0f), 0.25f);
  sum.add({0.45f, 0.05f}, Rgb(0.0f), 0.25f);
  sum.add({0.05f, 0.45f}, Rgb(0.0f), 0.25f);
  EXPECT_GE(sum.mean().r, 0.0f);
  EXPECT_LT(sum.mean().r, 0.34f);
}

}  // namespace
}  // namespace promenade::ibr
