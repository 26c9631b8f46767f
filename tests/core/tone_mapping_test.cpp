#include "src/core/tone_mapping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

namespace promenade {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Rgb driven(const Rgb& radiance, const ToneMapping& tone, const DisplayModel& display = {}) {
  return tone.at(0, display).drive(radiance);
}

/// White of 100 cd/m2 and true black in a dark room: an eye at it is adapted to 50 cd/m2.
DisplayModel tube() {
  DisplayModel display;
  display.peakLuminance = 100.0;
  display.blackLuminance = 0.0;
  display.ambientIlluminance = 0.0;
  return display;
}

/// A view whose code values are the radiance.
std::shared_ptr<const ColourView> asItIs() {
  ColourView view;
  view.codes = [](const Rgb& radiance) { return radiance; };
  return std::make_shared<const ColourView>(view);
}

ToneMapping eyeAt(ToneCurve curve, double adaptation) {
  return {.curve = curve, .adaptation = AdaptationCurve({{0, adaptation}}, 25.0), .view = asItIs()};
}

TEST(ToneMapping, LinearClipsAtOne) {
  const ToneMapping tone{.curve = ToneCurve::kLinear};
  EXPECT_EQ(driven(Rgb(0.25f, 1.0f, 7.0f), tone), Rgb(0.25f, 1.0f, 1.0f));
}

TEST(ToneMapping, ExposureIsInStops) {
  const ToneMapping tone{.curve = ToneCurve::kLinear, .exposureEv = -2.0};
  EXPECT_EQ(driven(Rgb(1.0f, 2.0f, 8.0f), tone), Rgb(0.25f, 0.5f, 1.0f));
}

TEST(ToneMapping, NeutralSubtractsTheFresnelOffsetFromMidTones) {
  const ToneMapping tone{.curve = ToneCurve::kNeutral};
  // Smallest channel 0.2 >= 0.08: the offset is 0.04 in all channels; the peak 0.46 is below 0.76: no
  // compression.
  const Rgb mapped = driven(Rgb(0.2f, 0.3f, 0.5f), tone);
  EXPECT_NEAR(mapped.r, 0.16f, 1e-6f);
  EXPECT_NEAR(mapped.g, 0.26f, 1e-6f);
  EXPECT_NEAR(mapped.b, 0.46f, 1e-6f);
  // Smallest 0.04 < 0.08: the offset is x - x^2 / 0.16 = 0.04 - 0.01 = 0.03.
  EXPECT_NEAR(driven(Rgb(0.04f, 0.5f, 0.5f), tone).r, 0.01f, 1e-6f);
}

TEST(ToneMapping, NeutralCompressesHighlights) {
  const ToneMapping tone{.curve = ToneCurve::kNeutral};
  // Grey 2: less 0.04 is 1.96; d = 0.24, new peak = 1 - 0.0576 / (1.96 + 0.24 - 0.76) = 0.96. Grey stays
  // grey.
  const Rgb mapped = driven(Rgb(2.0f), tone);
  EXPECT_NEAR(mapped.r, 0.96f, 1e-5f);
  EXPECT_NEAR(mapped.g, 0.96f, 1e-5f);
  EXPECT_NEAR(mapped.b, 0.96f, 1e-5f);
}

TEST(ToneMapping, NeutralRisesWithRadianceAndStaysInRange) {
  const ToneMapping tone{.curve = ToneCurve::kNeutral};
  float previous = -1.0f;
  for (int i = 0; i <= 400; ++i) {
    const float grey = driven(Rgb(std::exp2(static_cast<float>(i) / 20.0f - 10.0f)), tone).g;
    EXPECT_GE(grey, previous);
    EXPECT_LE(grey, 1.0f);
    previous = grey;
  }
}

TEST(ToneMapping, WhatIsNotARadianceBecomesBlackAndTheInfiniteWhite) {
  for (const ToneCurve curve : allToneCurves()) {
    SCOPED_TRACE(nameOf(curve));
    const ToneMapping tone{.curve = curve, .view = asItIs()};
    EXPECT_EQ(driven(Rgb(kNan), tone), Rgb(0.0f));
    EXPECT_EQ(driven(Rgb(-3.0f), tone), Rgb(0.0f));
    const Rgb white = driven(Rgb(kInfinity), tone);
    EXPECT_GT(white.g, 0.996f);
    EXPECT_LE(white.g, 1.0f);
  }
}

TEST(EncodeForDisplay, IsTheToneCurveThenSrgb) {
  RadianceMap radiance(1, 1, Rgb(0.18f, 0.36f, 4.0f));
  const EncodedMap encoded =
      encodeForDisplay(radiance, ToneMapping{.curve = ToneCurve::kLinear}.at(0, DisplayModel{}));
  EXPECT_NEAR(encoded(0, 0).r, 0.4613561f, 1e-6f);
  EXPECT_NEAR(encoded(0, 0).b, 1.0f, 1e-6f);
}

TEST(ToneMapping, WhatAConfigShowsAreCodeValuesWhateverTheDisplay) {
  ColourView view;
  view.codes = [](const Rgb& radiance) { return Rgb(2.0f * radiance.r, -radiance.g, kNan); };
  DisplayModel display;
  display.signal = Signal::kNative;
  display.transfer = TransferFunction::kLinear;
  const ToneMapping tone{
      .curve = ToneCurve::kOcio, .exposureEv = -1.0, .view = std::make_shared<const ColourView>(view)};
  // 2 * 0.3 behind an exposure of a half; what is below black, or nothing, is black.
  const EncodedMap encoded = encodeForDisplay(RadianceMap(1, 1, Rgb(0.3f, 0.5f, 0.5f)), tone.at(0, display));
  EXPECT_NEAR(encoded(0, 0).r, 0.3f, 1e-6f);
  EXPECT_EQ(encoded(0, 0).g, 0.0f);
  EXPECT_EQ(encoded(0, 0).b, 0.0f);
  // The display makes light of them as of any code values.
  EXPECT_NEAR(displayLuminance(encoded, display)(0, 0), display.luminanceOf(Rgb(0.3f, 0.0f, 0.0f)), 1e-3f);
}

TEST(ToneMapping, EveryCurveRisesFromBlackToWhite) {
  for (const ToneCurve curve : allToneCurves()) {
    SCOPED_TRACE(nameOf(curve));
    const FrameTone tone = eyeAt(curve, 20.0).at(0, DisplayModel{});
    float previous = 0.0f;
    for (int i = 0; i < 600; ++i) {
      const float grey = tone.drive(Rgb(std::exp2(static_cast<float>(i) / 20.0f - 12.0f))).g;
      EXPECT_GE(grey, previous - 1e-6f) << i;
      previous = grey;
    }
    EXPECT_GT(previous, 0.9f);
  }
}

TEST(ToneMapping, ModelsOfTheEyeShowAWorldThatIsLikeTheDisplayAsItIs) {
  for (const ToneCurve curve : allToneCurves()) {
    if (!modelsTheEye(curve)) continue;
    const FrameTone tone = eyeAt(curve, 50.0).at(0, tube());
    EXPECT_NEAR(tone.drive(Rgb(30.0f)).g, 0.3f, 1e-4f) << nameOf(curve);
    const Rgb colour = tone.drive(Rgb(60.0f, 20.0f, 10.0f));
    EXPECT_NEAR(colour.r / colour.b, 6.0f, 1e-3f) << nameOf(curve);
  }
}

TEST(ToneMapping, TheUnitMakesLuminanceOfRadiance) {
  ToneMapping tone = eyeAt(ToneCurve::kWard, 50.0);
  tone.candelasPerUnit = 200.0;
  EXPECT_NEAR(driven(Rgb(0.15f), tone, tube()).g, 0.3f, 1e-5f);
  // Exposed white is white paper in 500 lux, 500 / pi cd/m2; two stops more light, four times as much.
  EXPECT_NEAR(candelasFromExposure(0.0), 159.155, 1e-3);
  EXPECT_NEAR(candelasFromExposure(2.0), 636.620, 1e-3);
}

TEST(ToneMapping, LightThatIsOnTheScreenAnywayIsNotShownOnceMore) {
  DisplayModel display = tube();
  display.blackLuminance = 1.0;
  display.ambientIlluminance = 100.0 * 3.14159265;
  display.screenReflectance = 0.04;
  // 30 cd/m2 are wanted, 1 + 4 are there: 25 of the 99 between black and white are driven.
  const ToneMapping tone = eyeAt(ToneCurve::kWard, 50.0);
  EXPECT_NEAR(driven(Rgb(30.0f), tone, display).g, 25.0f / 99.0f, 1e-5f);
  EXPECT_EQ(driven(Rgb(4.0f), tone, display).g, 0.0f);
  const FrameTone frame = tone.at(0, display);
  EXPECT_NEAR(display.luminanceOf(frame.code(frame.drive(Rgb(30.0f)))), 30.0f, 1e-3f);
}

TEST(ToneMapping, FollowsTheWalk) {
  // The world becomes 100 times as bright: Ward's factor goes down.
  ToneMapping tone{.curve = ToneCurve::kWard};
  tone.adaptation = AdaptationCurve({{0, 50.0}, {1, 5000.0}, {100, 5000.0}}, 25.0);
  float previous = 1.0f;
  for (const int frame : {0, 1, 2, 5, 10}) {
    const float grey = tone.at(frame, tube()).drive(Rgb(30.0f)).g;
    EXPECT_LT(grey, previous);
    previous = grey;
  }
}

TEST(EncodeForDisplay, TakesFromAPictureWhatIsNotResolvedInTheDark) {
  RadianceMap stripes(64, 8);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 64; ++x) stripes(x, y) = Rgb(x % 2 == 0 ? 0.0f : 0.04f);
  }
  const auto contrast = [&](const EncodedMap& image) { return image(33, 4).g - image(32, 4).g; };
  const FrameTone dark = eyeAt(ToneCurve::kFerwerda, 0.02).at(0, DisplayModel{});
  EXPECT_GT(contrast(encodePoints(stripes, dark)), 0.1f);
  EXPECT_LT(contrast(encodeForDisplay(stripes, dark)), 0.01f);
  const FrameTone day = eyeAt(ToneCurve::kFerwerda, 1000.0).at(0, DisplayModel{});
  EXPECT_EQ(day.blur(), 0.0);
}

TEST(EncodeForDisplay, GivesANativeDisplayItsOwnCodeValues) {
  DisplayModel display = tube();
  display.signal = Signal::kNative;
  display.transfer = TransferFunction::kGamma;
  display.gamma = 2.5;
  display.primaries = {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, {0.3127, 0.3290}};
  const FrameTone tone = ToneMapping{.curve = ToneCurve::kLinear}.at(0, display);
  // Red of Rec.709 in BT.2020: ITU-R BT.2087-0, section 2: 0.6274, 0.0691, 0.0164.
  const Rgb red = tone.code(Rgb(1.0f, 0.0f, 0.0f));
  EXPECT_NEAR(red.r, std::pow(0.6274f, 0.4f), 1e-4f);
  EXPECT_NEAR(red.g, std::pow(0.0691f, 0.4f), 2e-4f);
  EXPECT_NEAR(red.b, std::pow(0.0164f, 0.4f), 5e-4f);
  // So it is as bright as Rec.709's red is to be, and white is white.
  EXPECT_NEAR(display.luminanceOf(red), 21.26f, 0.02f);
  EXPECT_NEAR(tone.code(Rgb(1.0f)).b, 1.0f, 1e-5f);
}

}  // namespace
}  // namespace promenade
