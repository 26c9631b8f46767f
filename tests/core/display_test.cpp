#include "src/core/display.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace promenade {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

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

TEST(ToneMap, LinearClipsAtOne) {
  const ToneMapping tone{ToneCurve::kLinear, 0.0};
  EXPECT_EQ(toneMap(Rgb(0.25f, 1.0f, 7.0f), tone), Rgb(0.25f, 1.0f, 1.0f));
}

TEST(ToneMap, ExposureIsInStops) {
  const ToneMapping tone{ToneCurve::kLinear, -2.0};
  EXPECT_EQ(toneMap(Rgb(1.0f, 2.0f, 8.0f), tone), Rgb(0.25f, 0.5f, 1.0f));
}

TEST(ToneMap, NeutralSubtractsTheFresnelOffsetFromMidTones) {
  const ToneMapping tone{ToneCurve::kNeutral, 0.0};
  // Smallest channel 0.2 >= 0.08: the offset is 0.04 in all channels; the peak 0.46 is below 0.76: no
  // compression.
  const Rgb mapped = toneMap(Rgb(0.2f, 0.3f, 0.5f), tone);
  EXPECT_NEAR(mapped.r, 0.16f, 1e-6f);
  EXPECT_NEAR(mapped.g, 0.26f, 1e-6f);
  EXPECT_NEAR(mapped.b, 0.46f, 1e-6f);
  // Smallest 0.04 < 0.08: the offset is x - x^2 / 0.16 = 0.04 - 0.01 = 0.03.
  EXPECT_NEAR(toneMap(Rgb(0.04f, 0.5f, 0.5f), tone).r, 0.01f, 1e-6f);
}

TEST(ToneMap, NeutralCompressesHighlights) {
  const ToneMapping tone{ToneCurve::kNeutral, 0.0};
  // Grey 2: less 0.04 is 1.96; d = 0.24, new peak = 1 - 0.0576 / (1.96 + 0.24 - 0.76) = 0.96. Grey stays
  // grey.
  const Rgb mapped = toneMap(Rgb(2.0f), tone);
  EXPECT_NEAR(mapped.r, 0.96f, 1e-5f);
  EXPECT_NEAR(mapped.g, 0.96f, 1e-5f);
  EXPECT_NEAR(mapped.b, 0.96f, 1e-5f);
}

TEST(ToneMap, NeutralRisesWithRadianceAndStaysInRange) {
  const ToneMapping tone{ToneCurve::kNeutral, 0.0};
  float previous = -1.0f;
  for (int i = 0; i <= 400; ++i) {
    const float grey = toneMap(Rgb(std::exp2(static_cast<float>(i) / 20.0f - 10.0f)), tone).g;
    EXPECT_GE(grey, previous);
    EXPECT_LE(grey, 1.0f);
    previous = grey;
  }
}

TEST(ToneMap, WhatIsNotARadianceBecomesBlackAndTheInfiniteWhite) {
  for (const ToneCurve curve : {ToneCurve::kLinear, ToneCurve::kNeutral}) {
    const ToneMapping tone{curve, 0.0};
    EXPECT_EQ(toneMap(Rgb(kNan), tone), Rgb(0.0f));
    EXPECT_EQ(toneMap(Rgb(-3.0f), tone), Rgb(0.0f));
    const Rgb white = toneMap(Rgb(kInfinity), tone);
    EXPECT_NEAR(white.g, 1.0f, 1e-5f);
    EXPECT_LE(white.g, 1.0f);
  }
}

TEST(EncodeForDisplay, IsTheToneCurveThenSrgb) {
  RadianceMap radiance(1, 1, Rgb(0.18f, 0.36f, 4.0f));
  const EncodedMap encoded = encodeForDisplay(radiance, {ToneCurve::kLinear, 0.0});
  EXPECT_NEAR(encoded(0, 0).r, 0.4613561f, 1e-6f);
  EXPECT_NEAR(encoded(0, 0).b, 1.0f, 1e-6f);
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
  display.transfer = TransferFunction::kGamma22;
  EXPECT_NEAR(display.luminanceOf(Rgb(0.5f)), 21.76376f, 1e-3f);
  display.transfer = TransferFunction::kLinear;
  EXPECT_NEAR(display.luminanceOf(Rgb(0.5f)), 50.0f, 1e-3f);
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
