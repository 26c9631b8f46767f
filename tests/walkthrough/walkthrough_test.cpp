#include "src/walkthrough/walkthrough.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

#include "src/core/errors.h"
#include "tests/walkthrough/analytic_renderer.h"
#include "tests/walkthrough/retracing_renderer.h"
#include "tests/walkthrough/walks.h"

namespace promenade::walkthrough {
namespace {

using testing::Each;
using tests::AnalyticRenderer;
using tests::kWalkSize;
using tests::Panel;
using tests::settingsFor;
using tests::still;
using tests::strafe;

/// Every other frame looks the other way.
paths::CameraPath cuts(int frames) {
  paths::CameraPath path = still(frames);
  for (int i = 1; i < frames; i += 2) {
    path.frames[static_cast<std::size_t>(i)].pose.worldFromCamera =
        glm::dmat3(glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1));
  }
  return path;
}

struct WalkResult {
  Statistics statistics;
  std::map<int, FinishedFrame> frames;
  std::vector<int> order;
  std::vector<Segment> judged;
};

WalkResult walk(const paths::CameraPath& path, const AnalyticRenderer& renderer, const Settings& settings) {
  WalkResult result;
  Outputs outputs;
  outputs.frame = [&](FinishedFrame&& frame) {
    result.order.push_back(frame.index);
    result.frames.emplace(frame.index, std::move(frame));
  };
  outputs.middle = [&](JudgedMiddle&& middle) { result.judged.push_back(middle.segment); };
  result.statistics = renderWalkthrough(path, renderer, settings, outputs);
  return result;
}

double largestDifference(const RadianceMap& a, const RadianceMap& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    for (int c = 0; c < 3; ++c)
      largest = std::max(largest, std::abs(double(a.pixels()[i][c]) - b.pixels()[i][c]));
  }
  return largest;
}

std::vector<int> upTo(int count) {
  std::vector<int> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

TEST(Walkthrough, StopsARendererThatHasItsOwnNumberOfPathsAfterTheFirst) {
  const auto path = strafe(9, 0.05);
  const AnalyticRenderer renderer(Panel::kMirrorLike);
  Settings settings = settingsFor(path);
  const WalkResult given = walk(path, renderer, settings);
  settings.stopping = StoppingRule{};
  const WalkResult stopped = walk(path, renderer, settings);
  for (const FrameStatistics& frame : stopped.statistics.frames) {
    ASSERT_TRUE(frame.stopping);
    EXPECT_EQ(frame.stopping->openTiles, 0);
    const FinishedFrame& a = stopped.frames.at(frame.index);
    const FinishedFrame& b = given.frames.at(frame.index);
    EXPECT_EQ(largestDifference(a.radiance, b.radiance), 0.0) << frame.index;
    for (std::size_t i = 0; i < a.source.pixels().size(); ++i) {
      ASSERT_EQ(a.source.pixels()[i], b.source.pixels()[i]) << frame.index;
    }
  }
}

TEST(Walkthrough, OfAStillCameraTracesKeyframesOnlyAndChangesNothing) {
  const auto path = still(33);
  const AnalyticRenderer renderer(Panel::kMatt);
  Settings settings = settingsFor(path);
  settings.keyframeSpacing = 16;
  const WalkResult result = walk(path, renderer, settings);
  EXPECT_EQ(result.order, upTo(33));
  // Keyframes at 0, 16, 32.
  EXPECT_EQ(result.statistics.keyframes(), 3);
  const std::uint64_t samplesOfAFrame = 64ull * 36 * 4;
  EXPECT_EQ(result.statistics.samplesTraced(), 3 * samplesOfAFrame + result.statistics.probes());
  // 1% of two middles.
  EXPECT_NEAR(static_cast<double>(result.statistics.probes()), 0.02 * static_cast<double>(samplesOfAFrame),
              60.0);
  for (const auto& [index, frame] : result.frames) {
    EXPECT_EQ(largestDifference(frame.radiance, result.frames.at(0).radiance), 0.0) << index;
  }
}

TEST(Walkthrough, FullFramesOfAStandingCameraAreIdentical) {
  // Moves, stands in frames 2 to 4, and comes back later to where it was.
  paths::CameraPath path = still(8);
  const double at[] = {0.0, 0.1, 0.2, 0.2, 0.2, 0.3, 0.2, 0.2};
  for (std::size_t i = 0; i < 8; ++i) path.frames[i].pose.eye.x = at[i];
  Settings settings = settingsFor(path);
  settings.method = Method::kFull;
  const auto frames = walk(path, AnalyticRenderer(Panel::kMatt, 0.1), settings).frames;
  const auto difference = [&](int a, int b) {
    return largestDifference(frames.at(a).radiance, frames.at(b).radiance);
  };
  EXPECT_EQ(difference(2, 3), 0.0);
  EXPECT_EQ(difference(2, 4), 0.0);
  EXPECT_EQ(difference(6, 7), 0.0);
  EXPECT_GT(difference(2, 6), 0.0);  // other random numbers: errors do not add up over the walk
}

TEST(Walkthrough, FramesOfAnotherRendererAreAskedForByTheirNumber) {
  const auto path = still(3);
  Settings settings = settingsFor(path);
  settings.method = Method::kFull;
  settings.holes = Holes::kStay;
  const AnalyticRenderer renderer(Panel::kMatt, 0.1);  // another noise for every number
  const auto frames = walk(path, renderer, settings).frames;
  EXPECT_GT(largestDifference(frames.at(0).radiance, frames.at(1).radiance), 0.0);
}

TEST(Walkthrough, DeliversEveryFrameOnceInTheOrderOfTime) {
  for (const double step : {0.0, 0.02, 0.4}) {
    const auto path = strafe(21, step);
    const AnalyticRenderer renderer(Panel::kMirrorLike);
    EXPECT_EQ(walk(path, renderer, settingsFor(path)).order, upTo(21)) << step;
  }
}

TEST(Walkthrough, TracesNoFrameTwiceAndCountsWhatItTraced) {
  const auto path = strafe(25, 0.1);
  const AnalyticRenderer renderer(Panel::kMirrorLike);
  const WalkResult result = walk(path, renderer, settingsFor(path));
  EXPECT_EQ(result.statistics.samplesTraced(), renderer.shaded());
  const std::uint64_t samplesOfAFrame = 64ull * 36 * 4;
  for (const FrameStatistics& frame : result.statistics.frames) {
    EXPECT_EQ(frame.samples, samplesOfAFrame);
    EXPECT_EQ(frame.samplesTraced + frame.warped, samplesOfAFrame);
    if (frame.kind == FrameKind::kInbetween) {
      EXPECT_EQ(frame.samplesTraced, frame.holes + frame.itemSamples);
    }
  }
}

TEST(Walkthrough, OfASlowStrafeIsCloseToTheFullFramesForAFractionOfThem) {
  const auto path = strafe(17, 0.02);
  Settings settings = settingsFor(path);
  const AnalyticRenderer renderer(Panel::kMatt);
  const WalkResult warped = walk(path, renderer, settings);
  settings.method = Method::kFull;
  const WalkResult full = walk(path, renderer, settings);
  EXPECT_LT(warped.statistics.tracedFraction(), 0.3);
  EXPECT_DOUBLE_EQ(full.statistics.tracedFraction(), 1.0);
  for (const auto& [index, frame] : warped.frames) {
    // The wall's waves have at most 0.2 * 2 = 0.4 of radiance a metre; a sample is 6 m / (2 * 33 px) = 0.09 m
    // wide, so that a neighbouring sample differs by at most 0.04. Column edges and the panel add nothing
    // here: exact silhouettes.
    EXPECT_LT(largestDifference(frame.radiance, full.frames.at(index).radiance), 0.04) << index;
  }
}

TEST(Walkthrough, TracesWhatNoKeyframeSawAsHoles) {
  auto path = still(3);
  path.frames[1].pose.eye.x = 0.3;
  Settings settings = settingsFor(path);
  settings.tolerancePercent = 100.0;  // never split
  settings.keyframeSpacing = 2;
  const AnalyticRenderer renderer(Panel::kMatt);
  const WalkResult result = walk(path, renderer, settings);
  ASSERT_EQ(result.statistics.keyframes(), 2);
  const FrameStatistics& middle = result.statistics.frames[1];
  // 72 rows of samples, focal length 36 / tan(0.5) = 65.9 samples. The column at 4 m hides a strip of the
  // wall at 6 m that moves by 0.3 * (6 / 4 - 1) = 0.15 m when the eye moves by 0.3: 0.15 * 65.9 / 6 = 1.6
  // samples of wall come free. On the right 0.3 * 65.9 / 6 = 3.3 samples of wall come into the image. Both to
  // a sample at either side.
  EXPECT_NEAR(static_cast<double>(middle.holes), 72.0 * (1.6 + 3.3), 72.0 * 2.0);
  EXPECT_EQ(middle.itemSamples, 0u);
}

/// To the right and back between two equal keyframes; the column hides a strip of wall from both of them.
paths::CameraPath thereAndBack(double amplitude) {
  auto path = still(9);
  for (int i = 0; i <= 8; ++i) {
    path.frames[static_cast<std::size_t>(i)].pose.eye.x = amplitude * std::sin(std::numbers::pi * i / 8.0);
  }
  return path;
}

TEST(Walkthrough, TracesWhatNoKeyframeSawOnceASegmentNotOnceAFrame) {
  const auto path = thereAndBack(0.6);
  Settings settings = settingsFor(path);
  settings.tolerancePercent = 100.0;  // never split
  settings.keyframeSpacing = 8;
  const AnalyticRenderer renderer(Panel::kMatt);
  const WalkResult result = walk(path, renderer, settings);
  ASSERT_EQ(result.statistics.keyframes(), 2);
  const auto& frames = result.statistics.frames;
  // The middle goes furthest and sees all that the others see of it. They miss as much in proportion to their
  // own offset, sin(pi i / 8) of the middle's, together 4.03 times as much. What is left for them to trace is
  // half a sample or so at the borders of each strip.
  std::uint64_t holes = 0;
  std::uint64_t reused = 0;
  for (const int i : {1, 2, 3, 5, 6, 7}) {
    holes += frames[static_cast<std::size_t>(i)].holes;
    reused += frames[static_cast<std::size_t>(i)].reused;
  }
  EXPECT_LT(static_cast<double>(holes), 0.5 * static_cast<double>(frames[4].holes));
  EXPECT_NEAR(static_cast<double>(holes + reused), 4.03 * static_cast<double>(frames[4].holes),
              0.4 * static_cast<double>(frames[4].holes));
  EXPECT_EQ(frames[4].reused, 0u);
}

TEST(Walkthrough, OfWhatOtherInbetweensTracedIsCloseToTheFullFrames) {
  const auto path = thereAndBack(0.6);
  Settings settings = settingsFor(path);
  settings.tolerancePercent = 100.0;
  settings.keyframeSpacing = 8;
  const AnalyticRenderer renderer(Panel::kMatt);
  const WalkResult warped = walk(path, renderer, settings);
  settings.method = Method::kFull;
  const WalkResult full = walk(path, renderer, settings);
  for (const auto& [index, frame] : warped.frames) {
    // A sample of the wall is 0.09 m wide, its waves change by 0.4 a metre: as above.
    EXPECT_LT(largestDifference(frame.radiance, full.frames.at(index).radiance), 0.04) << index;
  }
}

TEST(Walkthrough, TracesAMirrorThatAViewerWouldCatchAndMarksItsSource) {
  const auto path = strafe(17, 0.03);
  const AnalyticRenderer renderer(Panel::kMirrorLike);
  Settings settings = settingsFor(path);
  settings.supersample = 1;  // so that a pixel is one sample and its source is that of its item
  const WalkResult result = walk(path, renderer, settings);
  std::uint64_t itemSamples = 0;
  for (const FrameStatistics& frame : result.statistics.frames) {
    itemSamples += frame.itemSamples;
    if (frame.itemSamples > 0) {
      EXPECT_THAT(frame.itemsTraced, testing::ElementsAre(tests::kPanel));
    }
  }
  EXPECT_GT(itemSamples, 0u);
  for (const auto& [index, frame] : result.frames) {
    for (int y = 0; y < kWalkSize.height; ++y) {
      for (int x = 0; x < kWalkSize.width; ++x) {
        if (frame.source(x, y) == SampleSource::kTracedItem) {
          ASSERT_EQ(frame.visibility.item(x, y), tests::kPanel) << index << ": " << x << ", " << y;
        }
      }
    }
  }
}

TEST(Walkthrough, ThatCutsEveryFrameIsRight) {
  const auto path = cuts(5);
  Settings settings = settingsFor(path);
  const AnalyticRenderer renderer(Panel::kMatt);
  const WalkResult warped = walk(path, renderer, settings);
  settings.method = Method::kFull;
  const WalkResult full = walk(path, renderer, settings);
  for (const auto& [index, frame] : warped.frames) {
    EXPECT_EQ(largestDifference(frame.radiance, full.frames.at(index).radiance), 0.0) << index;
  }
}

TEST(Walkthrough, OfOneFrameIsAKeyframe) {
  const auto path = still(1);
  const AnalyticRenderer renderer(Panel::kMatt);
  const WalkResult result = walk(path, renderer, settingsFor(path));
  EXPECT_EQ(result.order, upTo(1));
  EXPECT_EQ(result.statistics.keyframes(), 1);
}

TEST(Walkthrough, RendersAPartOfThePath) {
  const auto path = strafe(30, 0.05);
  Settings settings = settingsFor(path);
  settings.frames = {7, 12};
  const AnalyticRenderer renderer(Panel::kMatt);
  EXPECT_THAT(walk(path, renderer, settings).order, testing::ElementsAre(7, 8, 9, 10, 11, 12));
}

TEST(Walkthrough, InPartsOfAnyOrderIsTheSameAsInOne) {
  const auto path = strafe(30, 0.1);
  for (const Method method : {Method::kImageBased, Method::kFull}) {
    Settings settings = settingsFor(path);
    settings.frames = {3, 28};
    settings.keyframeSpacing = 8;
    settings.method = method;
    settings.stopping = StoppingRule{};
    const AnalyticRenderer renderer(Panel::kMirrorLike);
    const WalkResult whole = walk(path, renderer, settings);
    Plan parts = partsOf(path, renderer, settings);
    // 3-11-19-27-28, or frames 3 to 28.
    ASSERT_EQ(parts.size(), method == Method::kImageBased ? 4u : 26u);
    std::map<int, Statistics> statistics;
    std::map<int, FinishedFrame> frames;
    for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
      const AnalyticRenderer another(Panel::kMirrorLike);  // on another machine
      Outputs outputs;
      outputs.frame = [&](FinishedFrame&& frame) {
        const int index = frame.index;
        EXPECT_TRUE(frames.emplace(index, std::move(frame)).second) << index << " twice";
      };
      outputs.part = [&](const Segment& told, const Statistics& s) {
        EXPECT_EQ(told, *part);
        statistics.emplace(told.first, s);
      };
      (void)renderParts(path, another, settings, {*part}, outputs);
    }
    Statistics together;
    for (const auto& [first, s] : statistics) together.append(s);
    ASSERT_EQ(together.frames.size(), whole.statistics.frames.size());
    ASSERT_EQ(together.segments.size(), whole.statistics.segments.size());
    EXPECT_EQ(together.rays(), whole.statistics.rays());
    for (std::size_t i = 0; i < together.frames.size(); ++i) {
      EXPECT_EQ(together.frames[i].index, whole.statistics.frames[i].index);
      EXPECT_EQ(together.frames[i].samplesTraced, whole.statistics.frames[i].samplesTraced);
      EXPECT_EQ(together.frames[i].rays, whole.statistics.frames[i].rays);
      EXPECT_EQ(together.frames[i].reused, whole.statistics.frames[i].reused);
      ASSERT_TRUE(together.frames[i].stopping);
      EXPECT_EQ(together.frames[i].stopping->paths, whole.statistics.frames[i].stopping->paths);
    }
    for (const auto& [index, frame] : whole.frames) {
      EXPECT_EQ(largestDifference(frame.radiance, frames.at(index).radiance), 0.0) << index;
    }
  }
}

Keyframe copyOf(const Keyframe& keyframe) {
  const Frame& f = keyframe.frame;
  const Visibility& v = f.visibility;
  return {{{v.camera, v.depth.clone(), v.normal.clone(), v.item.clone()},
           f.diffuse.clone(),
           f.viewDependent.clone(),
           f.source.clone()},
          keyframe.statistics};
}

/// In memory.
class CountingStore final : public KeyframeStore {
 public:
  [[nodiscard]] std::optional<Keyframe> find(int frame) const override {
    const auto found = kept_.find(frame);
    if (found == kept_.end()) return std::nullopt;
    ++handedOn_;
    return copyOf(found->second);
  }
  void keep(int frame, const Keyframe& keyframe) const override {
    EXPECT_TRUE(kept_.emplace(frame, copyOf(keyframe)).second) << frame << " traced twice";
  }
  [[nodiscard]] int handedOn() const { return handedOn_; }

 private:
  mutable std::map<int, Keyframe> kept_;
  mutable int handedOn_ = 0;
};

TEST(Walkthrough, PartsThatHandKeyframesOnTraceEachOnce) {
  const auto path = strafe(25, 0.1);
  Settings settings = settingsFor(path);
  settings.keyframeSpacing = 8;
  const AnalyticRenderer renderer(Panel::kMirrorLike);
  const WalkResult whole = walk(path, renderer, settings);
  const AnalyticRenderer apart(Panel::kMirrorLike);
  const CountingStore store;
  store.keep(8, traceKeyframe(path, apart, settings, 8));  // a task of its own
  Statistics together;
  for (const Segment& part : partsOf(path, renderer, settings)) {  // 0-8-16-24
    Outputs outputs;
    outputs.frame = [&](FinishedFrame&& frame) {
      EXPECT_EQ(largestDifference(frame.radiance, whole.frames.at(frame.index).radiance), 0.0) << frame.index;
    };
    together.append(renderParts(path, apart, settings, {part}, outputs, &store));
  }
  EXPECT_EQ(store.handedOn(), 3);  // 8 twice, 16 once
  EXPECT_EQ(together.rays(), whole.statistics.rays());
  EXPECT_EQ(apart.rayCounts(), renderer.rayCounts());
}

TEST(Walkthrough, TellsOfEveryKeyframeThatIsTraced) {
  const auto path = strafe(25, 0.1);
  for (const bool stops : {false, true}) {
    Settings settings = settingsFor(path);
    if (stops) settings.stopping = StoppingRule{};
    const AnalyticRenderer renderer(Panel::kMirrorLike);
    int told = 0;
    Outputs outputs;
    outputs.keyframe = [&](double seconds) {
      EXPECT_GT(seconds, 0.0);
      ++told;
    };
    const Statistics statistics = renderWalkthrough(path, renderer, settings, outputs);
    EXPECT_EQ(told, statistics.keyframes());
  }
}

TEST(Walkthrough, CountsTheRaysOfEveryFrameAndJudgementOnce) {
  const auto path = strafe(25, 0.1);
  const AnalyticRenderer renderer(Panel::kMirrorLike);
  const RayCounts counted = walk(path, renderer, settingsFor(path)).statistics.rays();
  EXPECT_EQ(counted, renderer.rayCounts());
}

TEST(Walkthrough, RefusesFramesOutsideThePath) {
  const auto path = still(5);
  Settings settings = settingsFor(path);
  settings.frames = {0, 5};
  const AnalyticRenderer renderer(Panel::kMatt);
  EXPECT_THROW((void)renderWalkthrough(path, renderer, settings, {}), InputError);
}

TEST(Walkthrough, StopsWhenProgressSaysSo) {
  const auto path = still(40);
  const AnalyticRenderer renderer(Panel::kMatt);
  int delivered = 0;
  Outputs outputs;
  outputs.frame = [&](FinishedFrame&&) { ++delivered; };
  outputs.progress = [](const Progress& progress) {
    if (progress.done == 3) throw Interrupted();
  };
  EXPECT_THROW((void)renderWalkthrough(path, renderer, settingsFor(path), outputs), Interrupted);
  EXPECT_EQ(delivered, 3);
}

TEST(ExposureOf, BringsTheLogAverageToMiddleGrey) {
  // Geometric mean of 0.09 and 0.36: 0.18.
  EXPECT_DOUBLE_EQ(exposureOf({0.09, 0.36}), 0.0);
  // 0.18 / 0.045 = 4: two stops.
  EXPECT_DOUBLE_EQ(exposureOf({0.045, 0.045}), 2.0);
}

TEST(ExposureOf, IsNotDecidedByABlackCorner) {
  // Mean (3 * 0.24 + 0) / 4 = 0.18, so black counts as 0.0018: log2(0.18) - (3 log2(0.24) + log2(0.0018)) / 4
  // = -2.474 - (-6.177 - 9.118) / 4 = 1.350.
  EXPECT_NEAR(exposureOf({0.24, 0.0, 0.24, 0.24}), 1.35, 0.0501);
  EXPECT_EQ(exposureOf({0.0, 0.24, 0.24, 0.24}), exposureOf({0.24, 0.24, 0.24, 0.0}));
}

TEST(ExposureOf, IsZeroWithoutLight) {
  EXPECT_EQ(exposureOf({}), 0.0);
  EXPECT_EQ(exposureOf({0.0, 0.0}), 0.0);
  EXPECT_EQ(exposureOf({std::numeric_limits<double>::quiet_NaN(), 0.18}), 0.0);
}

/// A wall of one grey that goes on with the light at `frame`.
class Grey final : public tests::RetracingRenderer {
 public:
  explicit Grey(int lightFrom = 0) : lightFrom_(lightFrom) {}
  [[nodiscard]] Visibility visibility(const Camera& camera) const override {
    return {camera, DepthMap(camera.size(), 1.0f), NormalMap(camera.size()), ItemBuffer(camera.size(), 1)};
  }
  void retrace(Frame& frame, const Mask& mask, SampleSource, int frameIndex) const override {
    for (std::size_t i = 0; i < mask.pixels().size(); ++i) {
      if (mask.pixels()[i] != 0) frame.diffuse.pixels()[i] = Rgb(frameIndex < lightFrom_ ? 0.0045f : 0.045f);
    }
  }

 private:
  int lightFrom_;
};

TEST(AutomaticExposure, BringsTheLogAverageToMiddleGrey) {
  // 0.18 / 0.045 = 4: two stops.
  EXPECT_DOUBLE_EQ(automaticExposure(still(10), {0, 9}, Grey(), {64, 36}), 2.0);
}

TEST(AdaptationAlong, SeesTheWalkBeforeItIsRendered) {
  // 25 frames a second: views of frames 2, 6, 10, 13.
  const AdaptationCurve curve = adaptationAlong(still(20), {2, 13}, Grey(8), {64, 36}, 1000.0);
  std::vector<int> frames;
  for (const View& view : curve.views()) frames.push_back(view.frame);
  EXPECT_THAT(frames, testing::ElementsAre(2, 6, 10, 13));
  EXPECT_NEAR(curve.at(2).now, 4.5, 1e-4);
  EXPECT_NEAR(curve.at(10).steady, 45.0, 1e-3);
  EXPECT_GT(curve.at(12).now, curve.at(10).now);
  EXPECT_LT(curve.at(12).now, 45.0);
}

TEST(AdaptationAlong, IsTheSameWheneverItIsAsked) {
  const AnalyticRenderer renderer(Panel::kMirrorLike);
  const AdaptationCurve once = adaptationAlong(strafe(9, 0.2), {0, 8}, renderer, kWalkSize, 100.0);
  const AdaptationCurve again = adaptationAlong(strafe(9, 0.2), {0, 8}, renderer, kWalkSize, 100.0);
  for (int frame = 0; frame < 9; ++frame) EXPECT_EQ(once.at(frame).now, again.at(frame).now);
}

}  // namespace
}  // namespace promenade::walkthrough
