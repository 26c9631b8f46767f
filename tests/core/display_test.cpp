#include "src/core/display.h"

#include <gtest/gtest.h>

namespace promenade {
namespace {

TEST(Luminance, OfWhiteIsOneAndGreenWeighsMost) {
  EXPECT_NEAR(luminance(Rgb(1.0f)), 1.0f, 1e-6f);
  EXPECT_FLOAT_EQ(luminance(Rgb(0.0f, 1.0f, 0.0f)), 0.7152f);
  EXPECT_FLOAT_EQ(luminance(Rgb(1.0f, 0.0f, 0.0f)), 0.2126f);
  EXPECT_FLOAT_EQ(luminance(Rgb(0.0f, 0.0f, 1.0f)), 0.0722f);
}

TEST(SrgbTransfer, HasTheStandardsValues) {
  // IEC 61966-2-1: linear 0.18 -> 1.055 * 0.18^(1/2.4) - 0.055 = 0.4613561.
  EXPECT_NEAR(encodeSrgb(0.18f), 0.4613561f, 1e-6f);
  EXPECT_NEAR(decodeSrgb(0.5f), 0.2140411f, 1e-6f);
  // The straight piece: 12.92 * 0.002 = 0.02584.
  EXPECT_NEAR(encodeSrgb(0.002f), 0.02584f, 1e-7f);
  EXPECT_EQ(encodeSrgb(0.0f), 0.0f);
  EXPECT_NEAR(encodeSrgb(1.0f), 1.0f, 1e-6f);
  EXPECT_EQ(encodeSrgb(-0.18f), -encodeSrgb(0.18f));
}

TEST(SrgbTransfer, DecodingUndoesEncoding) {
  for (int i = -255; i <= 255; ++i) {
    const float v = static_cast<float>(i) / 255.0f;
    EXPECT_NEAR(decodeSrgb(encodeSrgb(v)), v, 2e-6f);
  }
}

TEST(DisplayModel, PixelsPerDegreeFollowFromSizeAndDistance) {
  DisplayModel display;
  // 3:4:5 screen: 1600 x 1200 has a diagonal of 2000 pixels; 0.5 m diagonal: 0.25 mm a pixel.
  // One degree at 0.6 m spans 0.6 * tan(1 degree) = 10.47304 mm = 41.892 pixels.
  display.resolution = {1600, 1200};
  display.diagonalMetres = 0.5;
  display.viewingDistanceMetres = 0.6;
  EXPECT_NEAR(display.pixelsPerDegree(), 41.8921559, 1e-5);
}

TEST(DisplayModel, BlackAndWhiteHaveTheirLuminancePlusTheReflectedLight) {
  DisplayModel display;
  display.peakLuminance = 250.0;
  display.blackLuminance = 0.25;
  display.ambientIlluminance = 50.0;
  display.screenReflectance = 0.01;
  // Reflected: 50 * 0.01 / pi = 0.1591549 cd/m2.
  EXPECT_NEAR(display.luminanceOf(Rgb(0.0f)), 0.4091549f, 1e-6f);
  EXPECT_NEAR(display.luminanceOf(Rgb(1.0f)), 250.1591549f, 1e-3f);
}

TEST(DisplayModel, TransferFunctionDecodesTheCodeValue) {
  DisplayModel display;
  display.peakLuminance = 100.0;
  display.blackLuminance = 0.0;
  display.ambientIlluminance = 0.0;
  // sRGB 0.5 -> 0.2140411; 0.5^2.2 = 0.2176376; linear 0.5.
  EXPECT_NEAR(display.luminanceOf(Rgb(0.5f)), 21.40411f, 1e-3f);
  display.transfer = TransferFunction::kGamma;
  EXPECT_NEAR(display.luminanceOf(Rgb(0.5f)), 21.76376f, 1e-3f);
  display.transfer = TransferFunction::kLinear;
  EXPECT_NEAR(display.luminanceOf(Rgb(0.5f)), 50.0f, 1e-3f);
}

TEST(DisplayModel, EncodingUndoesDecoding) {
  DisplayModel display;
  for (const TransferFunction transfer :
       {TransferFunction::kSrgb, TransferFunction::kGamma, TransferFunction::kLinear}) {
    display.transfer = transfer;
    display.gamma = 2.35;
    for (int i = 0; i <= 20; ++i) {
      const float code = static_cast<float>(i) / 20.0f;
      EXPECT_NEAR(display.encoded(display.decoded(code)), code, 1e-5f);
    }
  }
}

TEST(DisplayModel, ItsPrimariesDecideHowBrightAColourIs) {
  DisplayModel display;
  display.peakLuminance = 100.0;
  display.blackLuminance = 0.0;
  display.ambientIlluminance = 0.0;
  display.transfer = TransferFunction::kLinear;
  EXPECT_NEAR(display.luminanceOf(Rgb(1.0f, 0.0f, 0.0f)), 21.26f, 1e-3f);
  // ITU-R BT.2020-2, table 4: Y = 0.2627 R + 0.6780 G + 0.0593 B.
  display.primaries = {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, {0.3127, 0.3290}};
  EXPECT_NEAR(display.luminanceOf(Rgb(1.0f, 0.0f, 0.0f)), 26.27f, 5e-3f);
  EXPECT_NEAR(display.luminanceOf(Rgb(0.0f, 1.0f, 0.0f)), 67.80f, 5e-3f);
  EXPECT_NEAR(display.luminanceOf(Rgb(1.0f)), 100.0f, 1e-3f);
}

TEST(DisplayModel, LuminanceIsAboveZeroEvenWithATrueBlack) {
  DisplayModel display;
  display.blackLuminance = 0.0;
  display.ambientIlluminance = 0.0;
  EXPECT_FLOAT_EQ(display.luminanceOf(Rgb(0.0f)), 1e-4f);
}

TEST(DisplayLuminance, MapsEveryPixel) {
  EncodedMap encoded(3, 1);
  encoded(1, 0) = Rgb(1.0f);
  encoded(2, 0) = Rgb(0.5f);
  const DisplayModel display;
  const LuminanceMap map = displayLuminance(encoded, display);
  ASSERT_EQ(map.size(), (Size{3, 1}));
  for (int x = 0; x < 3; ++x) EXPECT_EQ(map(x, 0), display.luminanceOf(encoded(x, 0)));
}

}  // namespace
}  // namespace promenade
