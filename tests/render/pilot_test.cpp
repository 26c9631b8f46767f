// How many paths a reflection gets: by hand, and that whole renders do not become darker by it.

#include "src/render/pilot.h"

#include <gtest/gtest.h>

#include <array>
#include <span>
#include <vector>

#include "src/render/irradiance_solution.h"
#include "src/render/path_renderer.h"
#include "tests/render/scenes.h"

namespace promenade::render {
namespace {

/// A sample with one reflection that is clean from `needed` paths on; its pilot had 16.
PilotedSample needing(float needed, glm::ivec2 position, std::uint32_t instance = 0) {
  PilotedSample sample{position, instance, {}};
  Pilot pilot;
  pilot.paths = pilot.wanted = 16;
  pilot.most = 128;
  pilot.variance = needed;
  pilot.squaredLimit = 1.0f;
  sample.pilots.lines.push_back(pilot);
  return sample;
}

/// The same, five in a row from x = 0 on.
std::vector<PilotedSample> rowNeeding(std::array<float, 5> needed) {
  std::vector<PilotedSample> row;
  for (const float n : needed) row.push_back(needing(n, {static_cast<int>(row.size()), 0}));
  choosePaths(row);
  return row;
}

int wanted(const PilotedSample& sample) {
  return sample.pilots.lines.front().wanted;
}

TEST(Pilots, TellTheirNeighboursButNotTheirOwnSample) {
  const std::vector<PilotedSample> row = rowNeeding({0.0f, 0.0f, 280.0f, 0.0f, 0.0f});
  EXPECT_EQ(wanted(row[2]), 16);  // no bright dot yet: 280 / 9 = 31 paths, rounded down
  // 280 / 4 = 70 paths, rounded down to 16 times a power of two.
  EXPECT_EQ(wanted(row[1]), 64);
  EXPECT_EQ(wanted(row[4]), 64);
}

TEST(Pilots, OfBrightDotsAskForTheirOwnSample) {
  const std::vector<PilotedSample> row = rowNeeding({0.0f, 0.0f, 1000.0f, 0.0f, 0.0f});
  // Three times the noise that is clean is left by 1000 / 9 = 111 paths, rounded down.
  EXPECT_EQ(wanted(row[2]), 64);
}

TEST(Pilots, AskForNoMoreThanThereAre) {
  EXPECT_EQ(wanted(rowNeeding({1e6f, 1e6f, 1e6f, 1e6f, 1e6f})[0]), 128);
  EXPECT_EQ(wanted(rowNeeding({31.0f, 31.0f, 31.0f, 31.0f, 31.0f})[0]), 16);
  EXPECT_EQ(wanted(rowNeeding({33.0f, 33.0f, 33.0f, 33.0f, 33.0f})[0]), 32);
}

TEST(Pilots, OfBlackReflectionsAskForNothing) {
  std::vector<PilotedSample> row = {needing(0.0f, {0, 0}), needing(0.0f, {1, 0})};
  for (PilotedSample& sample : row) sample.pilots.lines.front().squaredLimit = 0.0f;
  choosePaths(row);
  EXPECT_EQ(wanted(row[0]), 16);
}

TEST(Pilots, AreAskedThemselvesWhereFewAreBesideThem) {
  std::vector<PilotedSample> alone = {needing(70.0f, {3, 3})};
  choosePaths(alone);
  EXPECT_EQ(wanted(alone[0]), 64);
}

TEST(Pilots, OfOtherItemsAndFromAfarAreNotAsked) {
  std::vector<PilotedSample> samples = {needing(40.0f, {0, 0})};
  for (int i = 0; i < 8; ++i) {
    samples.push_back(needing(128.0f, {1, i - 4}, 1));
    samples.push_back(needing(128.0f, {kPilotReach + 1, i - 4}));
  }
  choosePaths(samples);
  EXPECT_EQ(wanted(samples[0]), 32);
}

TEST(Pilots, OfPanesAreAskedLineByLine) {
  std::vector<PilotedSample> samples;
  for (int i = 0; i < 6; ++i) {
    samples.push_back(needing(20.0f, {i, 0}));
    if (i < 5) samples.back().pilots.lines.push_back(needing(70.0f, {i, 0}).pilots.lines.front());
  }
  choosePaths(samples);
  EXPECT_EQ(samples[0].pilots.lines[0].wanted, 16);
  EXPECT_EQ(samples[0].pilots.lines[1].wanted, 64);
}

/// A polished metal floor under a ceiling of which an eighth shines, in narrow strips.
Scene stripsOverPolishedMetal() {
  Scene scene;
  Material metal;
  metal.roughness = 0.09f;
  scene.materials.push_back(metal);
  scene.materials.push_back(tests::emitter(Rgb(8.0f)));
  tests::place(scene, tests::quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, 0));
  for (int i = -60; i < 60; ++i) {
    const float x = 0.08f * static_cast<float>(i);
    tests::place(scene, tests::quad({x, 3, -8}, {0.01f, 0, 0}, {0, 0, 16}, 1));
  }
  scene.environment = tests::uniformSky(Rgb(0.1f));
  return scene;
}

TEST(PathRenderer, DoesNotDarkenReflectionsOfRareBrightThings) {
  const Scene scene = stripsOverPolishedMetal();
  const Camera camera = tests::lookingAt({0, 2, 1.5}, {0, 0, 0}, {48, 48}, 0.15);
  PathSettings settings;
  settings.pathsPerSample = 16;
  settings.solution = solveLight(scene, settings, std::span(&camera, 1), nullptr, {});
  const double adaptive = tests::meanRadiance(makePathRenderer(scene, settings)->render(camera, 0)).y;
  settings.solution = nullptr;
  settings.pathsPerSample = 256;
  const double paths = tests::meanRadiance(makePathRenderer(scene, settings)->render(camera, 1)).y;
  EXPECT_NEAR(adaptive, paths, 0.01 * paths);
}

}  // namespace
}  // namespace promenade::render
