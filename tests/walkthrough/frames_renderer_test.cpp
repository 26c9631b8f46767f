#include "src/walkthrough/frames_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/walkthrough/analytic_renderer.h"
#include "tests/walkthrough/walks.h"

namespace promenade::walkthrough {
namespace {

using tests::AnalyticRenderer;
using tests::Panel;
using tests::strafe;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// About the eye's upright axis, `step` radians a frame.
paths::CameraPath turn(int frames, double step) {
  auto path = tests::still(frames);
  for (int i = 0; i < frames; ++i) {
    const double angle = step * i;
    path.frames[static_cast<std::size_t>(i)].pose.worldFromCamera =
        glm::dmat3(std::cos(angle), 0, -std::sin(angle), 0, 1, 0, std::sin(angle), 0, std::cos(angle));
  }
  return path;
}

/// One sample a pixel; holes stay.
Settings settingsOfFrames(const paths::CameraPath& path) {
  Settings settings = tests::settingsFor(path, tests::kWalkSize, 1);
  settings.holes = Holes::kStay;
  settings.probeShare = 0.0;
  return settings;
}

/// Frames that an analytic renderer makes, counted.
struct AskedFrames {
  explicit AskedFrames(double mostUnknownPercent)
      : renderer(
            [this](const Camera& camera, int index) {
              ++asked;
              return real.render(camera, index);
            },
            {}, mostUnknownPercent) {}
  AnalyticRenderer real{Panel::kMatt};
  int asked = 0;
  FramesRenderer renderer;
};

TEST(FramesRenderer, MakesFramesBetweenThatAreCloseToTheRealOnesAndMarksWhatNobodyKnows) {
  const AskedFrames frames(100.0);
  const auto path = strafe(9, 0.05);
  Settings settings = settingsOfFrames(path);
  settings.tolerancePercent = 100.0;
  std::size_t unknown = 0;
  Outputs outputs;
  outputs.frame = [&](FinishedFrame&& frame) {
    const Frame expected = frames.real.render(path.camera(frame.index, settings.size), frame.index);
    for (int y = 0; y < settings.size.height; ++y) {
      for (int x = 0; x < settings.size.width; ++x) {
        if (frame.source(x, y) == SampleSource::kUnknown) {
          ++unknown;
          continue;
        }
        if (frame.visibility.item(x, y) != expected.visibility.item(x, y))
          continue;  // silhouettes: half a sample
        // The waves change by 0.4 a metre, a sample is 6 / 33 = 0.18 m wide: half a sample is 0.036.
        EXPECT_NEAR(frame.radiance(x, y).x, expected.diffuse(x, y).x, 0.04f)
            << frame.index << ": " << x << "," << y;
      }
    }
  };
  const Statistics statistics = renderParts(path, frames.renderer, settings, Plan{Segment{0, 8, 0}}, outputs);
  EXPECT_EQ(statistics.keyframes(), 2);
  std::uint64_t counted = 0;
  for (const FrameStatistics& frame : statistics.frames) {
    counted += frame.unknown;
    if (frame.kind == FrameKind::kInbetween) {
      EXPECT_EQ(frame.samplesTraced, 0u);
    }
  }
  EXPECT_EQ(counted, unknown);
  // The column hides up to 2 samples of wall from both ends at once, in at most 7 frames of 36 rows.
  EXPECT_LT(unknown, 7u * 36u * 3u);
}

TEST(FramesRenderer, AsksForMoreFramesWhereNothingIsKnown) {
  const AskedFrames frames(3.0);
  // Turning away by more than the view is wide: the middle shows what neither end does.
  const auto path = turn(9, 0.4);
  Settings settings = settingsOfFrames(path);
  const Statistics statistics = renderParts(path, frames.renderer, settings, Plan{Segment{0, 8, 0}}, {});
  EXPECT_GT(statistics.keyframes(), 2);
  EXPECT_EQ(frames.asked, statistics.keyframes());
}

TEST(FramesRenderer, HasAFrameMadeOfWhichTooMuchIsUnknown) {
  const auto path = strafe(9, 0.05);
  const Settings settings = settingsOfFrames(path);
  for (const double mostUnknownPercent : {0.0, 100.0}) {
    const AskedFrames frames(mostUnknownPercent);
    const Camera camera = path.camera(3, settings.size);
    Frame frame = unshaded(frames.renderer.visibility(camera));
    frames.renderer.retrace(frame, Mask(settings.size), SampleSource::kTracedHole, 3);  // nothing is open
    EXPECT_EQ(frame.visibility.item(20, 20), kNoItem);
    Mask one(settings.size);
    one(20, 20) = 1;
    frame.source(20, 20) = SampleSource::kUnknown;
    frames.renderer.retrace(frame, one, SampleSource::kTracedHole, 3);
    const bool isMade = mostUnknownPercent == 0.0;
    EXPECT_EQ(frame.source(20, 20), isMade ? SampleSource::kTraced : SampleSource::kUnknown);
    EXPECT_EQ(frame.diffuse(40, 30), isMade ? frames.real.render(camera, 3).diffuse(40, 30) : Rgb(0.0f));
  }
}

TEST(FramesRenderer, WhatAKeyframeSampledTooCoarselyIsBetterThanUnknown) {
  // Ahead, 0.3 m a frame: what the last frame does not see any more, beside its borders, the first one saw
  // from farther away, too coarsely for a limit of 1.
  const AskedFrames frames(100.0);
  auto path = tests::still(5);
  for (int i = 0; i < 5; ++i) path.frames[static_cast<std::size_t>(i)].pose.eye.z = -0.3 * i;
  Settings settings = settingsOfFrames(path);
  settings.tolerancePercent = 100.0;
  settings.warp.footprintLimit = 1.0;
  float worst = 0.0f;
  Outputs outputs;
  outputs.frame = [&](FinishedFrame&& frame) {
    const Frame expected = frames.real.render(path.camera(frame.index, settings.size), frame.index);
    EXPECT_NE(frame.source(0, 18), SampleSource::kUnknown) << frame.index;
    worst = std::max(worst, std::abs(frame.radiance(0, 18).x - expected.diffuse(0, 18).x));
  };
  const Statistics statistics = renderParts(path, frames.renderer, settings, Plan{Segment{0, 4, 0}}, outputs);
  EXPECT_LT(worst, 0.04f);  // half a sample, as above
  for (const FrameStatistics& frame : statistics.frames) {
    if (frame.kind != FrameKind::kInbetween) continue;
    // The wall is 6 to 4.8 m away: 1 - (4.8 / 5.1)^2 = 0.11 of frame 3 are not in the last.
    EXPECT_GT(frame.holes, frame.samples / 20) << frame.index;
    EXPECT_LT(frame.unknown, frame.holes / 10) << frame.index;
    EXPECT_EQ(frame.samplesTraced, 0u) << frame.index;
    EXPECT_EQ(frame.warped, frame.samples - frame.unknown) << frame.index;
  }
}

TEST(FramesRenderer, FramesThatHadToBeMadeCountAsKeyframesAndServeTheOthers) {
  const AskedFrames frames(0.0);
  const auto path = turn(9, 0.4);  // by more than the view is wide
  Settings settings = settingsOfFrames(path);
  settings.tolerancePercent = 100.0;  // no segment is split
  const Statistics statistics = renderParts(path, frames.renderer, settings, Plan{Segment{0, 8, 0}}, {});
  EXPECT_GT(frames.asked, 2);
  EXPECT_EQ(statistics.keyframes(), frames.asked);
  for (const FrameStatistics& frame : statistics.frames) {
    EXPECT_EQ(frame.unknown, 0u) << frame.index;
    EXPECT_EQ(frame.samplesTraced, frame.kind == FrameKind::kKeyframe ? frame.samples : 0u) << frame.index;
  }
}

TEST(Surroundings, FillAHoleWithWhatIsFarBesideIt) {
  RadianceMap radiance(5, 1, Rgb(1.0f));
  DepthMap depth(5, 1, 2.0f);
  Mask open(5, 1);
  radiance(3, 0) = radiance(4, 0) = Rgb(0.25f);
  depth(3, 0) = depth(4, 0) = 9.0f;
  open(2, 0) = 1;
  depth(2, 0) = kInfinity;
  const RadianceMap filled = surroundings(radiance, depth, open);
  EXPECT_EQ(filled(2, 0), Rgb(0.25f));
  EXPECT_EQ(filled(1, 0), Rgb(1.0f));
}

TEST(Surroundings, OfNothingAreLeftAsTheyAre) {
  const RadianceMap radiance(2, 2, Rgb(0.0f));
  EXPECT_EQ(surroundings(radiance, DepthMap(2, 2, kInfinity), Mask(2, 2, 1))(1, 1), Rgb(0.0f));
}

}  // namespace
}  // namespace promenade::walkthrough
