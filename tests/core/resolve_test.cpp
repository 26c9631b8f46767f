#include "src/core/resolve.h"

#include <gtest/gtest.h>

#include <limits>

namespace promenade {
namespace {

constexpr float kBackgroundDepth = std::numeric_limits<float>::infinity();

Visibility emptyVisibility(const Camera& camera) {
  const Size size = camera.size();
  return {camera, DepthMap(size, kBackgroundDepth), NormalMap(size), ItemBuffer(size)};
}

TEST(ResolveRadiance, IsTheMeanOfThePixelsSamples) {
  RadianceMap samples(4, 2);
  // Left pixel: 1, 2, 3, 6 -> 3. Right pixel: one sample of 8 -> 2.
  samples(0, 0) = Rgb(1.0f);
  samples(1, 0) = Rgb(2.0f);
  samples(0, 1) = Rgb(3.0f);
  samples(1, 1) = Rgb(6.0f);
  samples(3, 1) = Rgb(0.0f, 8.0f, 0.0f);
  const RadianceMap pixels = resolveRadiance(samples, 2);
  ASSERT_EQ(pixels.size(), (Size{2, 1}));
  EXPECT_EQ(pixels(0, 0), Rgb(3.0f));
  EXPECT_EQ(pixels(1, 0), Rgb(0.0f, 2.0f, 0.0f));
}

TEST(ResolveRadiance, ChangesNothingForOneSampleAPixel) {
  RadianceMap samples(3, 1);
  samples(2, 0) = Rgb(0.1f, 1e30f, 3.0f);
  const RadianceMap pixels = resolveRadiance(samples, 1);
  EXPECT_EQ(pixels(2, 0), samples(2, 0));
}

TEST(ResolveVisibility, TakesTheCentreSampleOfAnOddFactor) {
  Visibility samples = emptyVisibility(Camera(Pose{}, 1.0, Size{3, 3}));
  samples.depth(0, 0) = 1.0f;  // nearer, but not at the centre
  samples.depth(1, 1) = 5.0f;
  samples.normal(1, 1) = {0.0f, 1.0f, 0.0f};
  samples.item(1, 1) = 9;
  const Visibility pixels = resolveVisibility(samples, 3);
  ASSERT_EQ(pixels.depth.size(), (Size{1, 1}));
  EXPECT_EQ(pixels.depth(0, 0), 5.0f);
  EXPECT_EQ(pixels.normal(0, 0), glm::vec3(0.0f, 1.0f, 0.0f));
  EXPECT_EQ(pixels.item(0, 0), 9U);
}

TEST(ResolveVisibility, TakesTheNearestOfTheFourAroundTheCentreOfAnEvenFactorAndMixesNothing) {
  Visibility samples = emptyVisibility(Camera(Pose{}, 1.0, Size{4, 4}));
  samples.depth(1, 1) = 4.0f;
  samples.item(1, 1) = 1;
  samples.depth(2, 1) = 2.0f;
  samples.item(2, 1) = 2;
  samples.depth(0, 0) = 1.0f;  // a corner of the pixel: not around its centre
  samples.item(0, 0) = 3;
  const Visibility pixels = resolveVisibility(samples, 4);
  EXPECT_EQ(pixels.depth(0, 0), 2.0f);
  EXPECT_EQ(pixels.item(0, 0), 2U);
}

TEST(ResolveVisibility, KeepsTheBackgroundAtInfinity) {
  const Visibility pixels = resolveVisibility(emptyVisibility(Camera(Pose{}, 1.0, Size{2, 2})), 2);
  EXPECT_EQ(pixels.depth(0, 0), kBackgroundDepth);
  EXPECT_EQ(pixels.item(0, 0), kNoItem);
}

TEST(ResolveVisibility, GivesTheDisplayPixelsCamera) {
  const Camera display(Pose{}, 0.8, Size{5, 3}, {0.25, -0.5});
  const Visibility pixels = resolveVisibility(emptyVisibility(display.supersampled(4)), 4);
  EXPECT_EQ(pixels.camera.size(), display.size());
  EXPECT_NEAR(pixels.camera.focalPixels(), display.focalPixels(), 1e-12);
  EXPECT_EQ(pixels.camera.subpixelOffset(), display.subpixelOffset());
}

TEST(ResolveSource, IsTheMostFrequentAndOfEqualsTheMoreTraced) {
  SourceMap samples(4, 2, SampleSource::kBlended);
  samples(0, 0) = SampleSource::kTracedHole;  // 1 hole against 3 blended
  samples(2, 0) = SampleSource::kTracedItem;  // 2 items against 2 blended
  samples(3, 0) = SampleSource::kTracedItem;
  const SourceMap pixels = resolveSource(samples, 2);
  EXPECT_EQ(pixels(0, 0), SampleSource::kBlended);
  EXPECT_EQ(pixels(1, 0), SampleSource::kTracedItem);
}

TEST(CombinedRadiance, IsTheSumOfBothLayers) {
  Frame frame{emptyVisibility(Camera(Pose{}, 1.0, Size{1, 1})), RadianceMap(1, 1, Rgb(1.0f, 2.0f, 3.0f)),
              RadianceMap(1, 1, Rgb(0.5f, 0.0f, 4.0f)), SourceMap(1, 1)};
  EXPECT_EQ(combinedRadiance(frame)(0, 0), Rgb(1.5f, 2.0f, 7.0f));
}

}  // namespace
}  // namespace promenade
