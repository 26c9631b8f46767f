#include "ibr/temporal_filter.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "ibr/subpixel_offsets.h"
#include "src/core/errors.h"
#include "src/core/resolve.h"
#include "tests/ibr/analytic_scene.h"

namespace promenade::ibr::tests {
namespace {

constexpr Size kPixels{48, 32};
constexpr double kFocal = 40.0;  ///< display pixels
constexpr int kPeriod = 5;

/// All frames alike.
WindowMap wide() {
  return WindowMap(kPixels, std::numeric_limits<float>::infinity());
}

/// Frame `index` of a walk that moves by `step` metres to the right a frame, `supersample`^2 samples a pixel.
Frame frameAt(const AnalyticScene& scene, int index, double step, int supersample) {
  const Camera camera = cameraAt({step * index, 0, 0}, kPixels, kFocal).supersampled(supersample);
  return scene.render(camera.withSubpixelOffset(subpixelOffset(index, kPeriod)));
}

/// What converged pixels of frame 0 are: 16x16 samples each.
RadianceMap truth(const AnalyticScene& scene) {
  return resolveRadiance(
      combinedRadiance(scene.render(cameraAt({0, 0, 0}, kPixels, kFocal).supersampled(16))), 16);
}

/// Frame 0 of a walk, 4 samples a pixel, filtered with two frames before and two after.
RadianceMap filtered(const AnalyticScene& scene, double step) {
  std::vector<Frame> frames;
  for (int i = -2; i <= 2; ++i) frames.push_back(frameAt(scene, i, step, 2));
  const std::array<NearbyFrame, 4> others{
      {{&frames[0], -2}, {&frames[1], -1}, {&frames[3], 1}, {&frames[4], 2}}};
  return temporalFilter(frames[2], 2, others, wide(), {});
}

/// A strip 2.5 m before the camera that leans by one in eight, so much wide, from (x, -4) on.
Intersect strip(double x, double width) {
  return rectangle({x, -4, -2.5}, glm::dvec3(8, -1, 0) * (width / std::sqrt(65.0)), {1, 8, 0});
}

/// A wall with a smooth pattern and, before it, bars 0.16 pixels wide (a third of a sample).
AnalyticScene barsBeforeAWall() {
  AnalyticScene scene;
  scene.add(1, rectangle({-8, -4, -4}, {16, 0, 0}, {0, 8, 0}), waves(0.8));
  for (int i = 0; i < 4; ++i) scene.add(2, strip(-1.5 + 0.8 * i, 0.01), uniform({0.02f, 0.02f, 0.02f}));
  return scene;
}

/// The same wall behind a panel with slits as wide as those bars.
AnalyticScene slitsBeforeAWall() {
  AnalyticScene scene;
  scene.add(1, rectangle({-8, -4, -4}, {16, 0, 0}, {0, 8, 0}), waves(0.8));
  const double across = 0.5 * 8.0 / std::sqrt(65.0);  // of half a metre
  for (int i = 0; i < 14; ++i) scene.add(2, strip(-4.0 + 0.5 * i, across - 0.01), uniform(Rgb(0.02f)));
  return scene;
}

TEST(TemporalFilter, WithoutOtherFramesIsTheMeanOfThePixelsSamples) {
  const AnalyticScene scene = barsBeforeAWall();
  const Frame frame = frameAt(scene, 0, 0.0, 1);
  const RadianceMap pixels = temporalFilter(frame, 1, {}, wide(), {});
  // One sample a pixel fills all of its cells.
  EXPECT_LT(rmse(pixels, combinedRadiance(frame)), 1e-6);
}

/// The error of the filtered pixels, over that of sixteen samples a pixel of one frame.
double errorOverThatOfSixteen(const AnalyticScene& scene, double step) {
  const RadianceMap converged = truth(scene);
  const Camera camera = cameraAt({0, 0, 0}, kPixels, kFocal).supersampled(4);
  const double sixteen = rmse(resolveRadiance(combinedRadiance(scene.render(camera)), 4), converged);
  return rmse(filtered(scene, step), converged) / sixteen;
}

double meanOf(const RadianceMap& pixels) {
  double sum = 0.0;
  for (const Rgb& value : pixels.pixels()) sum += value.g;
  return sum / static_cast<double>(pixels.pixels().size());
}

TEST(TemporalFilter, MakesThinBarsAsGoodAsSixteenSamplesDoWhetherTheyRestOrMove) {
  const AnalyticScene scene = barsBeforeAWall();
  for (const double step : {0.0, 0.003, 0.05}) EXPECT_LT(errorOverThatOfSixteen(scene, step), 1.1) << step;
}

TEST(TemporalFilter, SeesThroughSlitsThatTheFramesOwnSamplesMiss) {
  const AnalyticScene scene = slitsBeforeAWall();
  EXPECT_LT(errorOverThatOfSixteen(scene, 0.0), 1.1);
  EXPECT_LT(errorOverThatOfSixteen(scene, 0.003), 1.1);
  // At a run no other frame sees what lies behind them now. The few samples that do speak for all frames, or
  // else the slits would have a fifth of their light.
  EXPECT_LT(errorOverThatOfSixteen(scene, 0.05), 1.5);
  const double light = meanOf(truth(scene));
  EXPECT_NEAR(meanOf(filtered(scene, 0.05)), light, 0.2 * light);
}

TEST(TemporalFilter, DoesNotSoftenASmoothTexture) {
  // Waves of 3 pixels.
  AnalyticScene scene;
  scene.add(1, rectangle({-8, -4, -4}, {16, 0, 0}, {0, 8, 0}), waves(0.3));
  const RadianceMap converged = truth(scene);
  const RadianceMap pixels = filtered(scene, 0.037);
  double ofTruth = 0.0;
  double along = 0.0;
  for (std::size_t i = 0; i < pixels.pixels().size(); ++i) {
    const double wave = converged.pixels()[i].g - 0.625;  // the mean of waves(), both layers
    ofTruth += wave * wave;
    along += wave * (pixels.pixels()[i].g - 0.625);
  }
  // Of a wave of three pixels the square of a pixel leaves sinc(1/3) = 0.827, the two samples across a pixel
  // of one frame cos(pi/6) = 0.866: with few samples contrast is a little too high, never too low.
  EXPECT_GT(along / ofTruth, 0.99);
  EXPECT_LT(along / ofTruth, 0.866 / 0.827);
}

/// A wall whose two layers are those given.
Frame wall(double eyeX, Rgb diffuse, Rgb viewDependent) {
  AnalyticScene scene;
  scene.add(1, rectangle({-20, -20, -4}, {40, 0, 0}, {0, 40, 0}), uniform(Rgb(1.0f)));
  Frame frame = scene.render(cameraAt({eyeX, 0, 0}, kPixels, kFocal).supersampled(2));
  for (Rgb& value : frame.diffuse.pixels()) value = diffuse;
  for (Rgb& value : frame.viewDependent.pixels()) value = viewDependent;
  return frame;
}

TEST(TemporalFilter, TakesReflectionsFromTheFrameItselfWhereTheyWouldSlide) {
  // 0.05 m before a wall 4 m away with 80 samples of focal length: reflections slide by a sample.
  const Frame frame = wall(0.0, Rgb(0.25f), Rgb(0.5f));
  const Frame other = wall(0.05, Rgb(0.25f), Rgb(4.0f));
  const std::array<NearbyFrame, 1> others{{{&other, 1}}};
  const RadianceMap pixels = temporalFilter(frame, 2, others, wide(), {});
  for (const Rgb& value : pixels.pixels()) EXPECT_NEAR(value.r, 0.75f, 1e-5f);
}

TEST(TemporalFilter, TakesReflectionsFromAllFramesOfACameraAtRest) {
  const Frame frame = wall(0.0, Rgb(0.25f), Rgb(0.5f));
  const Frame other = wall(0.0, Rgb(0.25f), Rgb(1.0f));
  const std::array<NearbyFrame, 1> others{{{&other, 1}}};
  const RadianceMap pixels = temporalFilter(frame, 2, others, wide(), {});
  for (const Rgb& value : pixels.pixels()) EXPECT_NEAR(value.r, 1.0f, 1e-5f);
}

TEST(TemporalFilter, LeavesNothingBehindOfWhatComesFreeOrIsCovered) {
  // A panel moves by 0.2 m x 40 / 2 m = 4 pixels a frame before a wall that hardly does (infinitely far).
  // Every pixel must have the radiance of what it shows, but for those at the panel's edges.
  AnalyticScene scene;
  scene.setBackground(uniform(Rgb(0.2f)))
      .add(1, rectangle({-0.3, -4, -2}, {0.6, 0, 0}, {0, 8, 0}), uniform(Rgb(0.8f)));
  const RadianceMap pixels = filtered(scene, 0.2);
  for (int x = 0; x < kPixels.width; ++x) {
    // The panel reaches from 24 - 6 to 24 + 6 pixels. Both layers together: 1.25 times the panel.
    if (std::abs(x - 17.5) < 1.0 || std::abs(x - 29.5) < 1.0) continue;
    EXPECT_NEAR(pixels(x, 16).r, x > 18 && x < 29 ? 1.0f : 0.25f, 1e-4f) << x;
  }
}

TEST(TemporalFilter, WeighsFramesByTheWindow) {
  const Frame frame = wall(0.0, Rgb(1.0f), Rgb(0.0f));
  const Frame other = wall(0.0, Rgb(0.0f), Rgb(0.0f));
  const std::array<NearbyFrame, 1> others{{{&other, -2}}};
  // exp(-2^2 / (2 x 2^2)) = 0.6065 beside 1.
  const RadianceMap pixels = temporalFilter(frame, 2, others, WindowMap(kPixels, 2.0f), {});
  EXPECT_NEAR(pixels(3, 4).r, 1.0f / 1.6065f, 1e-4f);
  // exp(-8): nothing.
  const RadianceMap narrow = temporalFilter(frame, 2, others, WindowMap(kPixels, 0.5f), {});
  EXPECT_NEAR(narrow(3, 4).r, 1.0f, 1e-6f);
}

TEST(TemporalFilter, SaysWhatDoesNotFitTogether) {
  const Frame frame = wall(0.0, Rgb(1.0f), Rgb(0.0f));
  const std::array<NearbyFrame, 1> itself{{{&frame, 0}}};
  EXPECT_THROW((void)temporalFilter(frame, 2, itself, wide(), {}), InputError);
  EXPECT_THROW((void)temporalFilter(frame, 5, {}, wide(), {}), InputError);
  EXPECT_THROW((void)temporalFilter(frame, 2, {}, WindowMap({3, 3}, 1.0f), {}), InputError);
  EXPECT_THROW((void)temporalFilter(frame, 2, {}, WindowMap(kPixels, 0.0f), {}), InputError);
}

}  // namespace
}  // namespace promenade::ibr::tests
