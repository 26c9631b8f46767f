#include "src/core/chiu.h"

#include <gtest/gtest.h>

#include <cmath>

#include "src/core/tone_mapping.h"

namespace promenade {
namespace {

Surroundings around(const RadianceMap& picture, float exposure = 1.0f) {
  const RadianceMap* const one[] = {&picture};
  return Surroundings(one, exposure);
}

/// A dark room, 0.05, whose right third is a window of 20.
RadianceMap roomWithWindow(Size size) {
  RadianceMap picture(size, Rgb(0.05f));
  for (int y = 0; y < size.height; ++y) {
    for (int x = size.width * 2 / 3; x < size.width; ++x) picture(x, y) = Rgb(20.0f);
  }
  return picture;
}

TEST(Surroundings, ThatAreUniformBecomeMiddleGrey) {
  for (const Size size : {Size{1, 1}, Size{3, 200}, Size{160, 90}}) {
    EXPECT_NEAR(5.0f * around(RadianceMap(size, Rgb(5.0f))).scaleAt({0.5f, 0.5f}), 0.18f, 1e-5f);
  }
  // A radiance of 5 and an exposure of 1/10 are 0.5.
  EXPECT_NEAR(around(RadianceMap(4, 4, Rgb(5.0f)), 0.1f).scaleAt({2.0f, 2.0f}), 0.18f / 0.5f, 1e-5f);
}

TEST(Surroundings, OfDarknessStayDark) {
  // Not below 0.18 / 16: the scale is 16 at most.
  EXPECT_NEAR(around(RadianceMap(8, 8, Rgb(1e-5f))).scaleAt({4.0f, 4.0f}), 16.0f, 1e-4f);
  EXPECT_NEAR(around(RadianceMap(8, 8)).scaleAt({4.0f, 4.0f}), 16.0f, 1e-4f);
}

TEST(Surroundings, BringOutBothTheRoomAndItsWindow) {
  const RadianceMap picture = roomWithWindow({192, 108});
  const Surroundings scales = around(picture);
  const float room = 0.05f * scales.scaleAt({20.0f, 54.0f});
  const float window = 20.0f * scales.scaleAt({170.0f, 54.0f});
  EXPECT_NEAR(room, 0.18f, 0.02f);  // far from the window: what is around it decides
  EXPECT_GT(window, room);
  EXPECT_LT(window, 1.0f);
  // Seldom is a place above white: the brightest surrounded by the dark is limited.
  for (float x = 0.5f; x < 192.0f; x += 1.0f) {
    EXPECT_LE(picture(static_cast<int>(x), 54).g * scales.scaleAt({x, 54.5f}), 1.25f) << x;
  }
}

TEST(Surroundings, VarySlowly) {
  const RadianceMap picture = roomWithWindow({192, 108});
  const Surroundings scales = around(picture);
  for (int x = 1; x < 192; ++x) {
    const float left = scales.scaleAt({static_cast<float>(x) - 0.5f, 54.5f});
    const float right = scales.scaleAt({static_cast<float>(x) + 0.5f, 54.5f});
    EXPECT_LT(std::abs(std::log(right / left)), 0.5f) << x;
  }
}

TEST(Surroundings, OfTwoPicturesAreThoseOfTheirMeanInEitherOrder) {
  const RadianceMap dark(16, 9, Rgb(1.0f));
  const RadianceMap bright(16, 9, Rgb(3.0f));
  const FrameTone tone = ToneMapping{.curve = ToneCurve::kChiu}.at(0, DisplayModel{});
  const Surroundings both = tone.around({&dark, &bright});
  EXPECT_NEAR(both.scaleAt({8.0f, 4.0f}), 0.09f, 1e-5f);  // 0.18 / 2
  const RadianceMap window = roomWithWindow({16, 9});
  for (float x = 0.0f; x < 16.0f; x += 0.7f) {
    EXPECT_EQ(tone.around({&dark, &window}).scaleAt({x, 2.0f}),
              tone.around({&window, &dark}).scaleAt({x, 2.0f}));
  }
  // A picture by itself is grey; two that are compared differ as they do: 0.09 and 0.27.
  EXPECT_NEAR(encodeForDisplay(dark, tone)(8, 4).g, encodeSrgb(0.18f), 1e-4f);
  EXPECT_NEAR(encodeForDisplay(dark, tone, both)(8, 4).g, encodeSrgb(0.09f), 1e-4f);
  EXPECT_NEAR(encodeForDisplay(bright, tone, both)(8, 4).g, encodeSrgb(0.27f), 1e-4f);
}

TEST(Surroundings, OfAToneThatKnowsOfNoneScaleNothing) {
  const RadianceMap picture(16, 9, Rgb(3.0f));
  const FrameTone tone = ToneMapping{.curve = ToneCurve::kAgx}.at(0, DisplayModel{});
  EXPECT_EQ(tone.around({&picture}).scaleAt({3.0f, 3.0f}), 1.0f);
}

}  // namespace
}  // namespace promenade
