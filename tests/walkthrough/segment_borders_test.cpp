// A segment's frames are warped from other keyframes than those of the segment before it: does a viewer see
// the walk jump where one ends?

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "aqm/metric.h"
#include "ibr/warp.h"
#include "src/walkthrough/seen.h"
#include "src/walkthrough/view.h"
#include "src/walkthrough/walkthrough.h"
#include "tests/walkthrough/scene_renderer.h"
#include "tests/walkthrough/walks.h"

namespace promenade::walkthrough {
namespace {

using ibr::tests::AnalyticScene;

/// A wall with waves a few pixels long, and a ball before it, of another texture.
AnalyticScene texturedScene() {
  using namespace ibr::tests;
  AnalyticScene scene;
  scene.setBackground(uniform(Rgb(0.6f)))
      .add(1, rectangle({-9, -4, -6}, {18, 0, 0}, {0, 8, 0}), waves(0.9))
      .add(2, sphere({0.6, 0.2, -4}, 0.7), waves(0.5));
  return scene;
}

/// Frames whose pixels are samples, as if all had been traced.
std::map<int, Frame> finished(const paths::CameraPath& path, const Renderer& renderer,
                              const Settings& settings, const Plan& parts) {
  std::map<int, Frame> frames;
  Outputs outputs;
  outputs.frame = [&](FinishedFrame&& frame) {
    const Size size = frame.radiance.size();
    frames.emplace(frame.index, Frame{std::move(frame.visibility), std::move(frame.radiance),
                                      RadianceMap(size), SourceMap(size, SampleSource::kTraced)});
  };
  (void)renderParts(path, renderer, settings, parts, outputs);
  return frames;
}

/// Mean pooled JND between a frame and the next one, moved back to it, where both show the same.
double change(const std::map<int, Frame>& frames, int index, const paths::CameraPath& path,
              const Settings& settings) {
  const Frame& earlier = frames.at(index);
  const ibr::Warped later = ibr::gatherWarp(frames.at(index + 1), earlier.visibility, settings.warp);
  RadianceMap moved = earlier.diffuse.clone();
  Mask excluded(moved.size(), 1);
  for (std::size_t i = 0; i < moved.pixels().size(); ++i) {
    if (later.validity.pixels()[i] != ibr::Validity::kValid) continue;
    moved.pixels()[i] = later.diffuse.pixels()[i];
    excluded.pixels()[i] = 0;
  }
  const auto seen =
      aqm::compare(seenOnDisplay(earlier.diffuse, index, settings), seenOnDisplay(moved, index, settings),
                   velocityOf(path, settings, earlier.visibility, index),
                   aqm::Settings{settings.display.pixelsPerDegree()});
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < excluded.pixels().size(); ++i) {
    if (excluded.pixels()[i] != 0) continue;
    sum += static_cast<double>(seen.pooledJnd.pixels()[i]);
    ++count;
  }
  return sum / count;
}

TEST(SegmentBorders, DoNotPop) {
  const auto path = tests::strafe(25, 0.03);
  const AnalyticScene scene = texturedScene();
  const tests::SceneRenderer renderer(scene);
  Settings settings = tests::settingsFor(path, {96, 54}, 1);
  settings.keyframeSpacing = 8;
  settings.tolerancePercent = 100.0;  // never split
  const Plan parts = equalPartsOf(settings);
  ASSERT_EQ(parts.size(), 3u);  // keyframes 0, 8, 16, 24
  const auto frames = finished(path, renderer, settings, parts);
  double atBorders = 0.0;
  double inside = 0.0;
  std::string all;
  for (int index = 0; index < 24; ++index) {
    const double jnd = change(frames, index, path, settings);
    const bool isAtBorder = index % 8 == 0 || index % 8 == 7;
    double& largest = isAtBorder ? atBorders : inside;
    largest = std::max(largest, jnd);
    all += std::to_string(index) + (isAtBorder ? "*" : "") + ": " + std::to_string(jnd) + " ";
  }
  RecordProperty("jnd", all);
  EXPECT_LE(atBorders, 1.25 * inside) << all;
  EXPECT_LT(atBorders, 1.0) << all;  // less than a viewer notices
}

}  // namespace
}  // namespace promenade::walkthrough
