#include "src/io/yuv420.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "src/io/palette.h"
#include "tests/io/temp_folder.h"

namespace promenade::io {
namespace {

TEST(Yuv420, HasTheStandardsBlackWhiteAndPrimaries) {
  // BT.709-6, 8 bits: Y = 16 + 219 Y', C = 128 + 224 C'.
  const Yuv420 black = toYuv420(EncodedMap(2, 2, Rgb(0.0f)));
  EXPECT_EQ(black.y[0], 16);
  EXPECT_EQ(black.cb[0], 128);
  EXPECT_EQ(black.cr[0], 128);
  const Yuv420 white = toYuv420(EncodedMap(2, 2, Rgb(1.0f)));
  EXPECT_EQ(white.y[0], 235);
  EXPECT_EQ(white.cb[0], 128);
  EXPECT_EQ(white.cr[0], 128);
  // Red: Y' = 0.2126 -> 62.56 -> 63; Cr' = 0.5 -> 240; Cb' = -0.2126 / 1.8556 = -0.114572 -> 102.34 -> 102.
  const Yuv420 red = toYuv420(EncodedMap(2, 2, Rgb(1.0f, 0.0f, 0.0f)));
  EXPECT_EQ(red.y[3], 63);
  EXPECT_EQ(red.cr[0], 240);
  EXPECT_EQ(red.cb[0], 102);
  // Blue: Y' = 0.0722 -> 31.81 -> 32; Cb' = 0.5 -> 240; Cr' = -0.0722 / 1.5748 = -0.045847 -> 117.73 -> 118.
  const Yuv420 blue = toYuv420(EncodedMap(2, 2, Rgb(0.0f, 0.0f, 1.0f)));
  EXPECT_EQ(blue.y[0], 32);
  EXPECT_EQ(blue.cb[0], 240);
  EXPECT_EQ(blue.cr[0], 118);
}

TEST(Yuv420, ChromaIsSitedWithTheLeftColumn) {
  // One red column at x = 2 of 6 on black: the chroma sample at x = 2 gets half of it, those at 0 and 4
  // nothing of it and (through the weight of x = 3 - 1 = 2 ... none): 1/4 reaches only odd neighbours 1 and
  // 3, which are not sampled.
  EncodedMap image(6, 2);
  for (int y = 0; y < 2; ++y) image(2, y) = Rgb(1.0f, 0.0f, 0.0f);
  const Yuv420 yuv = toYuv420(image);
  ASSERT_EQ(yuv.cr.size(), 3U);
  EXPECT_EQ(yuv.cr[0], 128);
  EXPECT_EQ(yuv.cr[1], 184);  // 128 + 224 * 0.5 * 0.5
  EXPECT_EQ(yuv.cr[2], 128);
  // At x = 3 the samples at 2 and 4 get a quarter each: 128 + 224 * 0.5 / 4 = 156.
  EncodedMap odd(6, 2);
  for (int y = 0; y < 2; ++y) odd(3, y) = Rgb(1.0f, 0.0f, 0.0f);
  EXPECT_EQ(toYuv420(odd).cr[1], 156);
  EXPECT_EQ(toYuv420(odd).cr[2], 156);
  EXPECT_EQ(toYuv420(odd).cr[0], 128);
}

TEST(Yuv420, OddSizesRepeatTheLastColumnAndRow) {
  const EncodedMap image = tests::noiseFrame({5, 3}, 1);
  const Yuv420 yuv = toYuv420(image);
  ASSERT_EQ(yuv.size, (Size{6, 4}));
  ASSERT_EQ(yuv.y.size(), 24U);
  ASSERT_EQ(yuv.cb.size(), 6U);
  for (std::size_t y = 0; y < 4; ++y) EXPECT_EQ(yuv.y[y * 6 + 5], yuv.y[y * 6 + 4]);
  for (std::size_t x = 0; x < 6; ++x) EXPECT_EQ(yuv.y[18 + x], yuv.y[12 + x]);
  EXPECT_EQ(evenSize({1, 1}), (Size{2, 2}));
  EXPECT_EQ(evenSize({8, 6}), (Size{8, 6}));
}

TEST(Yuv420, CodeValuesOutsideTheRangeAreClamped) {
  EXPECT_EQ(toYuv420(EncodedMap(1, 1, Rgb(9.0f))).y[0], 235);
  EXPECT_EQ(toYuv420(EncodedMap(1, 1, Rgb(-9.0f))).y[0], 16);
}

TEST(Palette, KeepsTheMeanOfAFlatColour) {
  // Ordered dither: over the 64 pixels of its tile the mean is right to within one step in 64 of a level.
  const auto palette = fixedPalette();
  const Rgb colour(0.3f, 0.55f, 0.81f);
  const auto indices = toPalette(EncodedMap(8, 8, colour));
  double red = 0.0;
  double green = 0.0;
  for (const std::uint8_t index : indices) {
    red += static_cast<double>((palette[index] >> 16) & 255U) / 255.0 / 64.0;
    green += static_cast<double>((palette[index] >> 8) & 255U) / 255.0 / 64.0;
  }
  EXPECT_NEAR(red, 0.3, 1.0 / 64.0 / 5.0 + 0.002);
  EXPECT_NEAR(green, 0.55, 1.0 / 64.0 / 6.0 + 0.002);
}

TEST(Palette, HasBlackAndWhiteAndIsOpaque) {
  const auto palette = fixedPalette();
  EXPECT_EQ(palette[toPalette(EncodedMap(1, 1, Rgb(0.0f)))[0]], 0xff000000U);
  EXPECT_EQ(palette[toPalette(EncodedMap(1, 1, Rgb(1.0f)))[0]], 0xffffffffU);
}

}  // namespace
}  // namespace promenade::io
