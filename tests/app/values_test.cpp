#include "src/app/values.h"

#include "tests/app/refused.h"

namespace promenade::app {
namespace {

TEST(Values, SizesAreWidthTimesHeight) {
  EXPECT_EQ(sizeFrom("1280x720", "--size"), (Size{1280, 720}));
  EXPECT_EQ(sizeFrom("1x65536", "--size"), (Size{1, 65536}));
  for (const char* wrong :
       {"", "x", "640", "0x5", "5x0", "-3x4", "640x360x2", "65537x1", "1e3x2", "640 x360"}) {
    SCOPED_TRACE(wrong);
    expectRefused([&] { (void)sizeFrom(wrong, "--size"); }, "--size: expected WIDTHxHEIGHT");
  }
}

TEST(Values, FramesAreARangeOfThoseThatThereAre) {
  EXPECT_EQ(framesFrom("3-7", 8, "--frames").last, 7);
  EXPECT_EQ(framesFrom("5", 8, "--frames").first, 5);
  EXPECT_EQ(framesFrom("5", 8, "--frames").last, 5);
  for (const char* wrong : {"", "-", "7-3", "a-b", "-1", "1-2-3"}) {
    SCOPED_TRACE(wrong);
    expectRefused([&] { (void)framesFrom(wrong, 8, "--frames"); }, "--frames: expected FIRST-LAST");
  }
  expectRefused([] { (void)framesFrom("0-8", 8, "--frames"); }, "expected frames within 0-7");
}

TEST(Values, NumbersAreTheWholeText) {
  EXPECT_EQ(numberFrom("2.5", 0, 10, "--x"), 2.5);
  EXPECT_EQ(numberFrom("+2.5", 0, 10, "--x"), 2.5);
  for (const char* wrong : {"", "nan", "inf", "2.5x", " 2", "11", "-1"}) {
    SCOPED_TRACE(wrong);
    expectRefused([&] { (void)numberFrom(wrong, 0, 10, "--x"); }, "--x: expected a number from 0 to 10");
  }
  EXPECT_EQ(integerFrom("7", 1, 9, "--n"), 7);
  expectRefused([] { (void)integerFrom("7.5", 1, 9, "--n"); }, "a whole number from 1 to 9");
  expectRefused([] { (void)integerFrom("99999999999999", 1, 9, "--n"); }, "a whole number");
}

TEST(Values, PairsCropsExposureAndChoices) {
  EXPECT_EQ(pairFrom("-3,4.5", "--velocity"), glm::vec2(-3.0f, 4.5f));
  expectRefused([] { (void)pairFrom("3", "--velocity"); }, "two numbers X,Y");
  const Crop crop = cropFrom("100x50+10+20", "--crop");
  EXPECT_EQ(crop.size, (Size{100, 50}));
  EXPECT_EQ(crop.x, 10);
  EXPECT_EQ(crop.y, 20);
  expectRefused([] { (void)cropFrom("100x50", "--crop"); }, "WIDTHxHEIGHT+X+Y");
  EXPECT_FALSE(exposureFrom("auto", "--exposure").has_value());
  EXPECT_EQ(exposureFrom("-1.5", "--exposure"), -1.5);
  expectRefused([] { (void)exposureFrom("bright", "--exposure"); }, "or 'auto', found 'bright'");
  EXPECT_EQ(toneFrom("linear", "--tone"), ToneCurve::kLinear);
  for (const ToneCurve curve : allToneCurves()) EXPECT_EQ(toneFrom(nameOf(curve), "--tone"), curve);
  expectRefused([] { (void)toneFrom("neutrall", "--tone"); }, "did you mean 'neutral'?");
}

TEST(Values, TheUnitIsForTonesOfTheEyeThatHaveNoExposure) {
  EXPECT_EQ(toneOptionsFrom("ward", "auto", "250").candelasPerUnit, 250.0);
  EXPECT_FALSE(toneOptionsFrom("ward", "1", "auto").candelasPerUnit.has_value());
  expectRefused([] { (void)toneOptionsFrom("neutral", "auto", "250"); }, "--unit: only the tones of the eye");
  expectRefused([] { (void)toneOptionsFrom("ward", "1", "250"); },
                "--unit, --exposure: expected one of them");
  expectRefused([] { (void)unitFrom("bright", "--unit"); }, "or 'auto', found 'bright'");
  expectRefused([] { (void)unitFrom("0", "--unit"); }, "the cd/m2 of a radiance of 1");
}

}  // namespace
}  // namespace promenade::app
