#include "src/app/heatmap.h"

#include <gtest/gtest.h>

#include "src/app/lettering.h"

namespace promenade::app {
namespace {

struct Panels {
  EncodedMap test, reference;
  ProbabilityMap probability;
  JndMap jnd;
  Mask excluded;
  explicit Panels(Size size)
      : test(size, Rgb(0.8f, 0.2f, 0.1f)), reference(size, Rgb(0.5f)), probability(size), jnd(size) {}
  [[nodiscard]] EncodedMap sheet() const {
    return heatmap({test, reference, probability, jnd, excluded}, "Frame 3");
  }
};

int pixelsOf(const EncodedMap& image, const Rgb& colour) {
  int count = 0;
  for (const Rgb& c : image.pixels()) count += c == colour ? 1 : 0;
  return count;
}

TEST(Heatmap, ShowsBothFramesAndBothMapsOnce) {
  // 600 x 300 is neither enlarged nor reduced.
  Panels frames(Size{600, 300});
  frames.probability(7, 9) = 0.751f;
  frames.jnd(7, 9) = 1.3f;
  const EncodedMap sheet = frames.sheet();
  EXPECT_EQ(pixelsOf(sheet, Rgb(0.8f, 0.2f, 0.1f)), 600 * 300);
  EXPECT_EQ(pixelsOf(sheet, Rgb(0.5f)), 600 * 300);
  EXPECT_GE(pixelsOf(sheet, visibilityColour(0.751f, 0.0f)), 1);
  EXPECT_GE(pixelsOf(sheet, jndColour(1.3f)), 1);
}

TEST(Heatmap, ColoursJumpWhereADifferenceCountsAsVisible) {
  const Rgb below = visibilityColour(0.75f, 0.3f);
  const Rgb above = visibilityColour(0.7501f, 0.3f);
  EXPECT_GT(below.b, below.r);
  EXPECT_GT(above.r, above.b + 0.5f);
  EXPECT_EQ(visibilityColour(0.0f, 0.3f), Rgb(0.3f));
  // What is visible has the same colour on every background.
  EXPECT_EQ(visibilityColour(0.9f, 0.1f), visibilityColour(0.9f, 0.6f));
}

TEST(Heatmap, JndColoursGrowBrighterAndEndAtEight) {
  float before = -1.0f;
  for (const float jnd : {0.0f, 0.25f, 0.5f, 1.0f, 2.0f, 4.0f, 8.0f}) {
    const Rgb c = jndColour(jnd);
    const float brightness = 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
    EXPECT_GT(brightness, before) << jnd;
    before = brightness;
  }
  EXPECT_EQ(jndColour(100.0f), jndColour(8.0f));
}

TEST(Heatmap, ShowsThePictureUnderTheJndMapOnlyWhereNothingIsSeen) {
  EXPECT_EQ(jndColourOver(0.0f, 0.2f), Rgb(0.2f));
  EXPECT_EQ(jndColourOver(1.0f, 0.2f), jndColour(1.0f));
  EXPECT_EQ(jndColourOver(3.0f, 0.2f), jndColour(3.0f));
}

TEST(Heatmap, HasAColourOfItsOwnForWhatTheMaskLeavesOut) {
  Panels frames(Size{600, 300});
  const Rgb leftOut(0.0f, 0.25f, 0.3f);
  EXPECT_EQ(pixelsOf(frames.sheet(), leftOut), 0);
  frames.excluded = Mask(Size{600, 300});
  for (int x = 0; x < 10; ++x) frames.excluded(x, 7) = 1;
  EXPECT_EQ(pixelsOf(frames.sheet(), leftOut), 20);  // in both maps
}

TEST(Heatmap, EnlargesSmallFramesAndReducesLargeOnesByWholeNumbers) {
  // 40 x 30: nine times, as 270 / 30 allows.
  EXPECT_EQ(pixelsOf(Panels(Size{40, 30}).sheet(), Rgb(0.5f)), 40 * 30 * 81);
  EXPECT_EQ(pixelsOf(Panels(Size{1, 1}).sheet(), Rgb(0.5f)), 270 * 270);
  // 5000 x 3: halved, the last row is a mean of one.
  EXPECT_EQ(pixelsOf(Panels(Size{5000, 3}).sheet(), Rgb(0.5f)), 2500 * 2);
  EXPECT_EQ(pixelsOf(Panels(Size{3, 5000}).sheet(), Rgb(0.5f)), 2500 * 2);
}

TEST(Heatmap, GreyPictureHasWhiteWhereItIsTold) {
  LuminanceMap luminance(2, 1, 50.0f);
  luminance(1, 0) = 100.0f;
  const EncodedMap picture = greyPicture(luminance, 100.0f);
  EXPECT_EQ(picture(1, 0), Rgb(1.0f));
  EXPECT_NEAR(picture(0, 0).g, 0.7297f, 1e-4f);  // 0.5^(1/2.2)
}

TEST(Lettering, DrawsCapitalsAndLeavesOutWhatIsOutside) {
  EncodedMap image(textWidth("I"), kLetterHeight, Rgb(0.0f));
  drawText(image, 0, 0, "i");
  // The serif and the stem of the I.
  EXPECT_EQ(image(2 * kDot, 3 * kDot), Rgb(1.0f));
  EXPECT_EQ(image(kDot, 0), Rgb(1.0f));
  EXPECT_EQ(image(kDot, 3 * kDot), Rgb(0.0f));
  EXPECT_EQ(pixelsOf(image, Rgb(1.0f)), 11 * kDot * kDot);
  EncodedMap cut(3, 3, Rgb(0.0f));
  drawText(cut, -5, -5, "MMMM");
  EncodedMap none(20, 20, Rgb(0.0f));
  drawText(none, 0, 0, "#~");
  EXPECT_EQ(pixelsOf(none, Rgb(1.0f)), 0);
}

}  // namespace
}  // namespace promenade::app
