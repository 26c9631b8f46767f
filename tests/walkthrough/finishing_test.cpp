#include "src/walkthrough/finishing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "aqm/metric.h"
#include "src/core/errors.h"
#include "src/walkthrough/seen.h"
#include "src/walkthrough/view.h"
#include "tests/walkthrough/analytic_renderer.h"
#include "tests/walkthrough/scene_renderer.h"
#include "tests/walkthrough/walks.h"

namespace promenade::walkthrough {
namespace {

using ibr::tests::AnalyticScene;
using ibr::tests::rmse;
using tests::AnalyticRenderer;
using tests::Panel;
using tests::SceneRenderer;

/// Moves by `step` metres a frame, to the right and a little forward.
paths::CameraPath walk(int frames, double step) {
  paths::CameraPath path;
  for (int i = 0; i < frames; ++i) {
    Pose pose;
    pose.eye = {i * step, 0.1 * i * step, -0.3 * i * step};
    path.frames.push_back({pose, 0.8});
  }
  path.framesPerSecond = 25.0;
  return path;
}

Settings filteredSettings(const paths::CameraPath& path) {
  Settings settings = tests::settingsFor(path);
  settings.antialiasing = Antialiasing{};
  return settings;
}

std::map<int, FinishedFrame> rendered(const paths::CameraPath& path, const Renderer& renderer,
                                      const Settings& settings, const Plan& parts) {
  std::map<int, FinishedFrame> frames;
  Outputs outputs;
  outputs.frame = [&](FinishedFrame&& frame) {
    const int index = frame.index;
    EXPECT_TRUE(frames.empty() || frames.rbegin()->first == index - 1) << index << " is not the next";
    frames.emplace(index, std::move(frame));
  };
  (void)renderParts(path, renderer, settings, parts, outputs);
  return frames;
}

TEST(WindowOf, IsTheNearestFramesOfThePart) {
  Settings settings;
  settings.antialiasing = Antialiasing{.radius = 2};
  const auto window = [&](int frame, FrameRange part) {
    const FrameRange found = windowOf(frame, part, settings);
    return std::pair(found.first, found.last);
  };
  EXPECT_EQ(window(10, {0, 16}), std::pair(8, 12));
  // As many at the ends of the part, to one side.
  EXPECT_EQ(window(0, {0, 16}), std::pair(0, 4));
  EXPECT_EQ(window(15, {0, 16}), std::pair(12, 16));
  // All of a short one.
  EXPECT_EQ(window(27, {27, 28}), std::pair(27, 28));
  EXPECT_EQ(window(5, {5, 5}), std::pair(5, 5));
}

TEST(WindowOf, IsTheFrameAloneWithoutAntialiasing) {
  const FrameRange found = windowOf(7, {0, 16}, Settings{});
  EXPECT_EQ(found.first, 7);
  EXPECT_EQ(found.last, 7);
}

TEST(Finishing, OfPartsInAnyOrderIsTheSameAsOfAllInOne) {
  const auto path = walk(22, 0.05);
  for (const Method method : {Method::kImageBased, Method::kFull}) {
    Settings settings = filteredSettings(path);
    settings.frames = {2, 20};
    settings.keyframeSpacing = 8;
    settings.method = method;
    const AnalyticRenderer renderer(Panel::kGlossy);
    const Plan parts = partsOf(path, renderer, settings);
    ASSERT_EQ(parts.size(), 3u);  // 18 frames, at most 8 each
    const auto whole = rendered(path, renderer, settings, parts);
    ASSERT_EQ(whole.size(), 19u);
    for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
      const AnalyticRenderer another(Panel::kGlossy);  // on another machine
      for (const auto& [index, frame] : rendered(path, another, settings, {*part})) {
        EXPECT_EQ(rmse(frame.radiance, whole.at(index).radiance), 0.0) << index;
      }
    }
  }
}

TEST(Finishing, KnowsThatNothingMovesThoughSamplePositionsDo) {
  const auto path = walk(9, 0.0);
  const AnalyticRenderer renderer(Panel::kMatt);
  const Settings settings = filteredSettings(path);
  for (const auto& [index, frame] : rendered(path, renderer, settings, equalPartsOf(settings))) {
    for (const glm::vec2& flow : frame.flowToNext.pixels()) ASSERT_EQ(flow, glm::vec2(0.0f)) << index;
  }
}

TEST(Finishing, RefusesAWindowWithoutFrames) {
  const auto path = walk(9, 0.0);
  const AnalyticRenderer renderer(Panel::kMatt);
  Settings settings = filteredSettings(path);
  settings.antialiasing->radius = 0;
  EXPECT_THROW((void)renderWalkthrough(path, renderer, settings, {}), InputError);
  settings.antialiasing = Antialiasing{.deviationFrames = 0.0};
  EXPECT_THROW((void)renderWalkthrough(path, renderer, settings, {}), InputError);
}

// Silhouettes, thin slanted bars (a third of a sample wide) and a wall whose pattern is a few pixels wide:
// what a pixel of four samples shows as stair steps and broken lines.
AnalyticScene sceneBefore(const ibr::tests::Texture& wall) {
  using namespace ibr::tests;
  AnalyticScene scene;
  scene.setBackground(uniform(Rgb(0.6f)))
      .add(1, rectangle({-9, -3, -6}, {18, 0, 0}, {0, 4.6, 0}), wall)
      .add(2, sphere({0.6, 0.2, -4}, 0.7), waves(0.5))
      .add(3, rectangle({-1.6, -4, -3.5}, {0.013, 0, 0}, {0.9, 8, 0}), uniform(Rgb(0.02f)))
      .add(4, rectangle({-4, -0.9, -3}, {0, 0.011, 0}, {8, 0.7, 0}), uniform({0.9f, 0.8f, 0.1f}));
  return scene;
}

struct Quality {
  double error = 0.0;           ///< RMSE over all frames
  double percentVisible = 0.0;  ///< mean over the frames
};

Quality against(const std::map<int, FinishedFrame>& truth, const std::map<int, FinishedFrame>& frames,
                const paths::CameraPath& path, const Settings& settings) {
  Quality quality;
  for (const auto& [index, frame] : frames) {
    const RadianceMap& converged = truth.at(index).radiance;
    const double error = rmse(frame.radiance, converged);
    quality.error += error * error;
    const auto seen = aqm::compare(seenOnDisplay(frame.radiance, index, settings),
                                   seenOnDisplay(converged, index, settings),
                                   velocityOf(path, settings, truth.at(index).visibility, index),
                                   aqm::Settings{settings.display.pixelsPerDegree()});
    quality.percentVisible += aqm::percentVisible(seen.probability, Mask());
  }
  const auto count = static_cast<double>(frames.size());
  return {std::sqrt(quality.error / count), quality.percentVisible / count};
}

enum class Wall { kWaves, kStripes };
struct Walk {
  Wall wall = Wall::kWaves;
  double metresAFrame = 0.0;
  double mostOfSixteen = 1.0;  ///< largest error over that of 16 samples a pixel
};

/// Every frame traced, so that nothing but antialiasing is compared, against 64 samples a pixel.
class Antialiased : public testing::TestWithParam<Walk> {
 protected:
  [[nodiscard]] Quality of(int supersample, std::optional<Antialiasing> antialiasing) {
    Settings settings = base_;
    settings.supersample = supersample;
    settings.antialiasing = antialiasing;
    return against(truth_, rendered(path_, renderer_, settings, equalPartsOf(settings)), path_, base_);
  }
  static Quality record(const std::string& name, const Quality& quality) {
    RecordProperty(name, std::to_string(quality.error) + ", " + std::to_string(quality.percentVisible) + "%");
    return quality;
  }

 private:
  [[nodiscard]] static Settings fullSettings(const paths::CameraPath& path) {
    Settings settings = tests::settingsFor(path);
    settings.method = Method::kFull;
    return settings;
  }
  [[nodiscard]] std::map<int, FinishedFrame> truth() {
    Settings settings = base_;
    settings.supersample = 8;
    return rendered(path_, renderer_, settings, equalPartsOf(settings));
  }

  paths::CameraPath path_ = walk(8, GetParam().metresAFrame);
  Settings base_ = fullSettings(path_);
  AnalyticScene scene_ =
      sceneBefore(GetParam().wall == Wall::kWaves ? ibr::tests::waves(0.9) : ibr::tests::stripes(0.9));
  SceneRenderer renderer_{scene_};
  std::map<int, FinishedFrame> truth_ = truth();
};

TEST_P(Antialiased, FourSamplesAPixelAreAsGoodAsSixteen) {
  const Quality filtered = record("4_samples_filtered", of(2, Antialiasing{}));
  const Quality sixteen = record("16_samples", of(4, std::nullopt));
  const Quality four = record("4_samples", of(2, std::nullopt));
  record("4_samples_filtered_radius_2", of(2, Antialiasing{.radius = 2}));
  record("4_samples_filtered_deviation_2", of(2, Antialiasing{.deviationFrames = 2.0}));
  EXPECT_LT(filtered.error, GetParam().mostOfSixteen * sixteen.error);
  EXPECT_LT(filtered.error, 0.65 * four.error);
  if (GetParam().mostOfSixteen <= 1.0) {
    EXPECT_LE(filtered.percentVisible, sixteen.percentVisible + 1.0);
  }
}

// A wall of waves three pixels long, at rest, 0.1 degrees a second, 3.5, and 18 (a run past a wall 6 m away).
// Then a texture of hard stripes that nothing has filtered, which a renderer would not leave like this: at a
// run the error of chance places exceeds that of a regular grid that is aligned with the pixel.
INSTANTIATE_TEST_SUITE_P(Paths, Antialiased,
                         testing::Values(Walk{Wall::kWaves, 0.0, 0.85}, Walk{Wall::kWaves, 0.0005, 0.4},
                                         Walk{Wall::kWaves, 0.015, 0.75}, Walk{Wall::kWaves, 0.08, 0.75},
                                         Walk{Wall::kStripes, 0.0, 0.8}, Walk{Wall::kStripes, 0.08, 1.2}),
                         [](const auto& made) {
                           return std::string(made.param.wall == Wall::kWaves ? "Waves" : "Stripes") +
                                  std::to_string(std::lround(made.param.metresAFrame * 1e4));
                         });

}  // namespace
}  // namespace promenade::walkthrough
