// The view-independent solution of the light on matt surfaces: interpolation by hand, and whole renders
// against closed forms.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "src/core/fnv1a.h"
#include "src/render/irradiance_records.h"
#include "src/render/irradiance_solution.h"
#include "src/render/path_renderer.h"
#include "src/render/path_tracer.h"
#include "tests/render/gathering.h"
#include "tests/render/scenes.h"

namespace promenade::render {
namespace {

using tests::kUp;

SurfaceLight lightOf(float value) {
  return {Rgb(value), (2.0f / 3.0f) * kUp};
}

TEST(IrradianceRecords, SayNothingBeyondTheirReach) {
  IrradianceRecords records;
  records.place({{0, 0, 0}, kUp, 1.0f});
  records.setLight({lightOf(2.0f)});
  ASSERT_TRUE(records.at({0.9f, 0, 0}, kUp).has_value());
  EXPECT_FLOAT_EQ(records.at({0.9f, 0, 0}, kUp)->radiance.r, 2.0f);
  EXPECT_FALSE(records.at({1.1f, 0, 0}, kUp).has_value());
}

TEST(IrradianceRecords, KeepApartWhatFacesElsewhereOrLiesOnAnotherPlane) {
  IrradianceRecords records;
  records.place({{0, 0, 0}, kUp, 1.0f});
  records.setLight({lightOf(1.0f)});
  EXPECT_FALSE(records.at({0, 0, 0}, {1, 0, 0}).has_value());
  EXPECT_FALSE(records.at({0, 0, 0}, -kUp).has_value());     // the other side of a thin wall
  EXPECT_FALSE(records.at({0, -0.3f, 0}, kUp).has_value());  // a step
  EXPECT_TRUE(records.at({0, -0.05f, 0}, kUp).has_value());
}

TEST(IrradianceRecords, MeetHalfwayBetweenEqualNeighbours) {
  IrradianceRecords records;
  records.place({{0, 0, 0}, kUp, 1.0f});
  records.place({{1, 0, 0}, kUp, 1.0f});
  records.setLight({lightOf(1.0f), lightOf(3.0f)});
  EXPECT_FLOAT_EQ(records.at({0.5f, 0, 0}, kUp)->radiance.r, 2.0f);
  // A quarter of the way the weights are 1 - 0.25 and 1 - 0.75: (0.75 * 1 + 0.25 * 3) / 1.
  EXPECT_NEAR(records.at({0.25f, 0, 0}, kUp)->radiance.r, 1.5f, 1e-5f);
}

TEST(IrradianceRecords, AreFoundAcrossTheBordersOfTheirCells) {
  IrradianceRecords records;
  // Negative coordinates, a reach that is not a power of two, a place next to a cell's corner.
  records.place({{-3.999f, 4.001f, -8.0f}, kUp, 0.7f});
  records.setLight({lightOf(1.0f)});
  for (int i = 0; i < 64; ++i) {
    const float angle = 6.2831853f * static_cast<float>(i) / 64.0f;
    const glm::vec3 offset(0.69f * std::cos(angle), 0.0f, 0.69f * std::sin(angle));
    EXPECT_TRUE(records.at(glm::vec3(-3.999f, 4.001f, -8.0f) + offset, kUp).has_value()) << i;
  }
}

TEST(IrradianceRecords, CoverOnlyWhatIsNear) {
  IrradianceRecords records;
  records.place({{0, 0, 0}, kUp, 1.0f});
  EXPECT_TRUE(records.coverage({0.5f, 0, 0}, kUp).covered);
  EXPECT_FALSE(records.coverage({0.7f, 0, 0}, kUp).covered);  // within reach, but another record helps
  EXPECT_FLOAT_EQ(records.coverage({0.7f, 0, 0}, kUp).finestReach, 1.0f);
}

TEST(IrradianceRecords, TellTheCoveredFromTheKnown) {
  IrradianceRecords records;
  records.place({{0, 0, 0}, kUp, 1.0f});
  EXPECT_TRUE(records.coverage({0, 0, 0}, kUp).coveredNew);
  records.setLight({lightOf(2.0f)});
  EXPECT_FALSE(records.coverage({0, 0, 0}, kUp).coveredNew);
  records.place({{10, 0, 0}, kUp, 1.0f});
  EXPECT_TRUE(records.coverage({10, 0, 0}, kUp).coveredNew);
  EXPECT_FALSE(records.at({10, 0, 0}, kUp).has_value());
}

TEST(IrradianceRecords, DoNotLookPastDetailsThatTheirNeighboursKnow) {
  IrradianceRecords records;
  records.place({{0, 0, 0}, kUp, 0.2f});
  // 0.2 + 0.5 * 0.1, whatever it faces; and nothing changes where nothing is near.
  EXPECT_FLOAT_EQ(records.clampedReach({0.1f, 0, 0}, 1.0f, 0.5f), 0.25f);
  EXPECT_FLOAT_EQ(records.clampedReach({50.0f, 0, 0}, 1.0f, 0.5f), 1.0f);
}

/// Records on a grid over the floor, 0.7 apart with reach 1, lit as `value` says.
template <class Value>
IrradianceRecords floorRecords(const Value& value, float error) {
  IrradianceRecords records;
  std::vector<SurfaceLight> light;
  for (int z = -4; z <= 4; ++z) {
    for (int x = -4; x <= 4; ++x) {
      records.place({{0.7f * static_cast<float>(x), 0.0f, 0.7f * static_cast<float>(z)}, kUp, 1.0f});
      light.push_back(lightOf(value(x, z)));
      light.back().error = error;
    }
  }
  records.setLight(std::move(light));
  return records;
}

TEST(IrradianceRecords, FollowALinearChangeBetweenThemAndNearlySoBeyond) {
  const IrradianceRecords records =
      floorRecords([](int x, int z) { return 20.0f + 0.7f * static_cast<float>(2 * x - 4 * z); }, 0.0f);
  // 20 + 2 x - 4 z.
  EXPECT_NEAR(records.at({0.13f, 0, -0.31f}, kUp)->radiance.r, 20.0f + 2.0f * 0.13f + 4.0f * 0.31f, 0.05f);
  // Outside the grid the gradients alone carry on, up to 0.5 metres here; the ridge holds them back by some
  // per cent.
  EXPECT_NEAR(records.at({3.3f, 0, 0.1f}, kUp)->radiance.r, 20.0f + 2.0f * 3.3f - 4.0f * 0.1f, 0.4f);
}

TEST(IrradianceRecords, TakeOutNoiseThatNeighboursDoNotShare) {
  const auto checkered = [](int x, int z) { return 5.0f + ((x + z) % 2 == 0 ? 0.2f : -0.2f); };
  // Known only to 0.3: the mean is the better guess. Known exactly: nothing is touched at the record.
  const IrradianceRecords noisy = floorRecords(checkered, 0.3f);
  EXPECT_NEAR(noisy.roughlyAt({0, 0, 0}, kUp)->radiance.r, 5.0f, 0.05f);
  const IrradianceRecords exact = floorRecords(checkered, 0.0f);
  EXPECT_NEAR(exact.roughlyAt({0, 0, 0}, kUp)->radiance.r, 5.2f, 1e-4f);
}

// Half of the records are by chance too bright by half, and know that little less well than the others: what
// takes the noise out believes the dark ones, and only what is left as it was is right on average.
TEST(IrradianceRecords, KeepTheirMeanWhereNoiseIsLeftIn) {
  const auto meanOf = [](IrradianceRecords::Noise noise) {
    IrradianceRecords records;
    std::vector<SurfaceLight> light;
    for (int z = -6; z <= 6; ++z) {
      for (int x = -6; x <= 6; ++x) {
        records.place({{0.7f * static_cast<float>(x), 0.0f, 0.7f * static_cast<float>(z)}, kUp, 1.0f});
        const bool isBright = (x + z) % 2 == 0;
        light.push_back(lightOf(isBright ? 1.5f : 0.5f));
        light.back().error = isBright ? 0.6f : 0.1f;
      }
    }
    records.setLight(std::move(light), {}, noise);
    double sum = 0.0;
    int count = 0;
    for (int z = -2; z <= 1; ++z) {
      for (int x = -2; x <= 1; ++x, ++count) {
        sum += records.roughlyAt({0.7f * static_cast<float>(x), 0.0f, 0.7f * static_cast<float>(z)}, kUp)
                   ->radiance.r;
      }
    }
    return sum / count;
  };
  EXPECT_NEAR(meanOf(IrradianceRecords::Noise::kLeftIn), 1.0, 1e-5);
  EXPECT_LT(meanOf(IrradianceRecords::Noise::kTakenOut), 0.8);
}

TEST(IrradianceRecords, AreLeftOutWhereTheyReachTooFar) {
  IrradianceRecords records;
  records.place({{0, 0, 0}, kUp, 1.0f});
  records.place({{0.3f, 0, 0}, kUp, 0.5f});
  records.setLight({lightOf(4.0f), lightOf(1.0f)});
  // A gradient changes a record's light by half at most.
  EXPECT_GE(records.roughlyAt({-0.1f, 0, 0}, kUp, 1.0f)->radiance.r, 2.0f);
  EXPECT_LE(records.roughlyAt({-0.1f, 0, 0}, kUp, 0.9f)->radiance.r, 1.5f);
  EXPECT_FALSE(records.roughlyAt({-0.3f, 0, 0}, kUp, 0.9f).has_value());
  EXPECT_FALSE(records.roughlyAt({-0.1f, 0, 0}, kUp, 0.4f).has_value());
}

TEST(IrradianceRecords, SayNothingOfWhatLiesBehindTheirWalls) {
  IrradianceRecords records;
  const RecordWall wall{{-1, 0, 0}, -0.25f};  // at x = 0.25
  records.place({{0, 0, 0}, kUp, 1.0f}, std::span(&wall, 1));
  records.setLight({lightOf(2.0f)});
  EXPECT_TRUE(records.at({0.25f, 0, 0.3f}, kUp).has_value());
  EXPECT_TRUE(records.at({0.259f, 0, 0.3f}, kUp).has_value());  // a gap under the wall, say
  EXPECT_FALSE(records.at({0.261f, 0, 0.3f}, kUp).has_value());
  EXPECT_FALSE(records.roughlyAt({0.27f, 0, 0}, kUp).has_value());
  EXPECT_TRUE(records.coverage({0.2f, 0, 0}, kUp).covered);
  EXPECT_FALSE(records.coverage({0.3f, 0, 0}, kUp).covered);
  EXPECT_TRUE(records.at({-0.9f, 0, 0}, kUp).has_value());
}

TEST(IrradianceRecords, KeepWhatStandsOutOfTheNoise) {
  const IrradianceRecords records =
      floorRecords([](int x, int z) { return x == 0 && z == 0 ? 9.0f : 5.0f; }, 0.3f);
  EXPECT_NEAR(records.roughlyAt({0, 0, 0}, kUp)->radiance.r, 9.0f, 1e-4f);
}

TEST(IrradianceRecords, ShowNoSpotWhereOnePathBroughtTenTimesTheLight) {
  IrradianceRecords records;
  std::vector<SurfaceLight> light;
  for (int z = -3; z <= 3; ++z) {
    for (int x = -3; x <= 3; ++x) {
      records.place({{0.7f * static_cast<float>(x), 0.0f, 0.7f * static_cast<float>(z)}, kUp, 1.0f});
      const bool isSpot = x == 0 && z == 0;
      light.push_back(lightOf(isSpot ? 50.0f : 5.0f));
      light.back().error = isSpot ? 45.0f : 0.1f;
    }
  }
  records.setLight(std::move(light));
  // Error over light is 0.9, nine times what makes a record doubtful: it counts 1 / 82. Even at its own
  // place, where it would count most, hardly 45 / 82 = 0.55 is left, and less the second time. (If it counted
  // like the others, a fifth and more of the 45 would be left.)
  EXPECT_NEAR(records.at({0, 0, 0}, kUp)->radiance.r, 5.0f, 0.25f);
  EXPECT_NEAR(records.at({0.35f, 0, 0.35f}, kUp)->radiance.r, 5.0f, 0.25f);
}

TEST(IrradianceRecords, RoughlyAgreeWithTheirInterpolation) {
  const IrradianceRecords records =
      floorRecords([](int x, int z) { return 20.0f + static_cast<float>(x - z); }, 0.0f);
  for (float x = -1.0f; x < 1.0f; x += 0.17f) {
    const glm::vec3 place(x, 0.0f, 0.4f * x);
    EXPECT_NEAR(records.roughlyAt(place, kUp)->radiance.r, records.at(place, kUp)->radiance.r, 0.15f) << x;
  }
  EXPECT_FALSE(records.roughlyAt({50, 0, 0}, kUp).has_value());
}

// at() weighs several records at a time, coverage() one by one: both must find the same ones, or the mean
// would leave the range that each by itself gives.
TEST(IrradianceRecords, AreTheSameSeveralAtATimeAsOneByOne) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
  const auto anyPoint = [&] { return glm::vec3(unit(random), unit(random), unit(random)); };
  const auto anyNormal = [&] { return glm::normalize(kUp + 0.7f * anyPoint()); };
  IrradianceRecords records;
  std::vector<SurfaceLight> light;
  for (int i = 0; i < 61; ++i) {
    records.place({anyPoint() * glm::vec3(1.0f, 0.1f, 1.0f), anyNormal(), 0.6f + 0.5f * unit(random)});
    light.push_back(lightOf(2.0f + unit(random)));
  }
  records.setLight(light);
  int found = 0;
  for (int i = 0; i < 3000; ++i) {
    const glm::vec3 position = 1.5f * anyPoint() * glm::vec3(1.0f, 0.2f, 1.0f);
    const glm::vec3 normal = anyNormal();
    const IrradianceRecords::Coverage one = records.coverage(position, normal);
    const std::optional<SurfaceLight> all = records.at(position, normal);
    ASSERT_EQ(all.has_value(), std::isfinite(one.finestReach));
    ASSERT_EQ(records.roughlyAt(position, normal).has_value(), all.has_value());
    if (!all) continue;
    ++found;
    EXPECT_GE(all->radiance.r, one.least * 0.9999f);
    EXPECT_LE(all->radiance.r, one.most * 1.0001f);
  }
  EXPECT_GT(found, 500);
  EXPECT_LT(found, 2900);
}

/// What a place 1 m above a floor that fills its view and sends back half of the light gathers, as often.
tests::Spread gatherAboveFloor(LightSolution solution, int times) {
  Scene scene;
  scene.materials.push_back(tests::diffuseMaterial(Rgb(0.5f)));
  tests::place(scene, tests::quad({-2e3f, 0, 2e3f}, {4e3f, 0, 0}, {0, 0, -4e3f}, 0));
  PathTracer tracer(scene, PathSettings{});
  tracer.setSolution(std::make_shared<const LightSolution>(std::move(solution)));
  return tests::gatherOften(tracer, {0, 1, 0}, -kUp, times);
}

TEST(PathTracer, GathersTheSameFromEverywhereNearlyWithoutNoise) {
  LightSolution solution;
  solution.fine.place({{0, 0, 0}, kUp, 1e4f});
  solution.fine.setLight({lightOf(1.0f)});
  const auto [mean, deviation] = gatherAboveFloor(std::move(solution), 16);
  EXPECT_NEAR(mean, 0.5, 0.002);
  // A path's weight z / (0.0625 / sqrt(z) + 0.75 z) at height z lies between 0 and 1.23: a relative deviation
  // of 0.32, a sixteenth of that for 256 independent paths. That is smooth over the square of random
  // numbers, so stratified paths leave less than a fifth of it.
  EXPECT_LT(deviation, 0.2 * 0.32 / 16.0);
}

TEST(PathTracer, GathersFromCoarseRecordsOnlyWhatIsFarForTheirReach) {
  // A record that says 1 within 8 m around the foot of the place, and no other light: it counts from 2 m on,
  // that is where the cosine is under 1/2, and ends where it is 1 / sqrt(65). Shares of the light go by its
  // square.
  LightSolution solution;
  solution.coarse.place({{0, 0, 0}, kUp, 8.0f});
  solution.coarse.setLight({lightOf(1.0f)});
  EXPECT_NEAR(gatherAboveFloor(std::move(solution), 64).mean, 0.5 * (1.0 / 4.0 - 1.0 / 65.0), 0.003);
}

TEST(RadianceOnTurned, FollowsTheCosineForASingleLight) {
  // Light from 45 degrees, seen by a surface turned toward it: 1 / cos 45.
  const glm::vec3 light = glm::vec3(1, 1, 0) / std::sqrt(2.0f);
  EXPECT_NEAR(radianceOnTurned({Rgb(1.0f), light}, kUp, light).r, std::sqrt(2.0f), 1e-4f);
  EXPECT_EQ(radianceOnTurned({Rgb(1.0f), light}, kUp, -light).r, 0.0f);
}

TEST(RadianceOnTurned, LosesTheShareOfAUniformSkyThatSinksBelowTheHorizon) {
  // (1 + cos 60) / 2 = 0.75.
  const glm::vec3 turned(std::sqrt(0.75f), 0.5f, 0.0f);
  EXPECT_NEAR(radianceOnTurned(lightOf(1.0f), kUp, turned).r, 0.75f, 1e-4f);
  EXPECT_FLOAT_EQ(radianceOnTurned(lightOf(1.0f), kUp, kUp).r, 1.0f);
}

// --- Whole renders ---

double meanWithSolution(const Scene& scene, const Camera& camera, PathSettings settings) {
  settings.solution = solveLight(scene, settings, std::span(&camera, 1), nullptr, {});
  return tests::meanRadiance(makePathRenderer(scene, settings)->render(camera, 0)).y;
}

PathSettings fewPaths() {
  PathSettings settings;
  settings.pathsPerSample = 8;
  settings.maxBounces = 6;
  return settings;
}

Scene floorScene(const Material& material) {
  Scene scene;
  scene.materials.push_back(material);
  tests::place(scene, tests::quad({-50.0f, 0.0f, 50.0f}, {100.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -100.0f}, 0));
  return scene;
}

TEST(LightSolution, LeavesAWhiteSphereInvisibleUnderAUniformSky) {
  Scene scene;
  scene.materials.push_back(tests::diffuseMaterial(Rgb(1.0f)));
  tests::place(scene, tests::sphere({0, 0, 0}, 1.0f, 96, 48, 0));
  scene.environment = tests::uniformSky(Rgb(1.0f));
  const Camera camera = tests::lookingAt({0, 0, 4}, {0, 0, 0}, {48, 48}, 0.35);
  EXPECT_NEAR(meanWithSolution(scene, camera, fewPaths()), 1.0, 0.01);
}

TEST(LightSolution, LeavesAGlossyWhiteSphereInvisibleToo) {
  Scene scene;
  Material glossy;
  glossy.metallic = 0.0f;
  glossy.roughness = 0.4f;
  scene.materials.push_back(glossy);
  tests::place(scene, tests::sphere({0, 0, 0}, 1.0f, 96, 48, 0));
  scene.environment = tests::uniformSky(Rgb(1.0f));
  const Camera camera = tests::lookingAt({0, 0, 4}, {0, 0, 0}, {48, 48}, 0.35);
  EXPECT_NEAR(meanWithSolution(scene, camera, fewPaths()), 1.0, 0.02);
}

TEST(LightSolution, AddsDirectionalLightOnceAndExactly) {
  Scene scene = floorScene(tests::diffuseMaterial(Rgb(0.25f)));
  PunctualLight light;
  light.type = PunctualLight::Type::kDirectional;
  light.intensity = Rgb(3.0f);
  light.direction = glm::normalize(glm::vec3(1.0f, -1.0f, 0.0f));
  scene.lights.push_back(light);
  // albedo / pi * lux * cos 45; nothing else shines, the records themselves are black.
  const double expected = 0.25 / tests::kPi * 3.0 * std::sqrt(0.5);
  const Camera camera = tests::lookingAt({0.3, 3.0, 2.0}, {0, 0, 0}, {16, 16}, 0.5);
  EXPECT_NEAR(meanWithSolution(scene, camera, fewPaths()), expected, 1e-3 * expected);
}

TEST(LightSolution, AgreesWithPathsUnderAPanel) {
  // A panel of 2 m by 2 m, 2 m above the floor: soft light with a strong gradient.
  Scene scene = floorScene(tests::diffuseMaterial(Rgb(0.5f)));
  Material lamp = tests::diffuseMaterial(Rgb(0.0f));
  lamp.emission = Rgb(5.0f);
  scene.materials.push_back(lamp);
  tests::place(scene, tests::quad({-1.0f, 2.0f, -1.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 2.0f}, 1));
  const Camera camera = tests::lookingAt({0.0, 1.0, 3.0}, {0, 0, 0}, {160, 120}, 0.7);
  PathSettings settings = fewPaths();
  settings.pathsPerSample = 32;
  const double paths = tests::meanRadiance(makePathRenderer(scene, settings)->render(camera, 0)).y;
  EXPECT_NEAR(meanWithSolution(scene, camera, fewPaths()), paths, 0.02 * paths);
}

TEST(LightSolution, AgreesWithPathsUnderASmallSunlitSpot) {
  // A ceiling lit only by a spot of light on a dark floor, as through a small window.
  Scene scene = floorScene(tests::diffuseMaterial(Rgb(0.05f)));
  scene.materials.push_back(tests::diffuseMaterial(Rgb(0.8f)));
  tests::place(scene, tests::quad({-3.0f, 2.5f, -3.0f}, {6.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 6.0f}, 1));
  tests::place(scene, tests::quad({1.0f, 0.01f, 0.5f}, {0.5f, 0.0f, 0.0f}, {0.0f, 0.0f, -0.5f}, 1));
  PunctualLight light;
  light.type = PunctualLight::Type::kDirectional;
  light.intensity = Rgb(100.0f);
  light.direction = glm::normalize(glm::vec3(-4.0f, -1.5f, 0.0f));  // in under the ceiling's edge
  scene.lights.push_back(light);
  const Camera camera = tests::lookingAt({0.0, 0.6, 2.0}, {0.2, 2.5, -0.2}, {64, 48}, 0.7);
  PathSettings settings = fewPaths();
  settings.pathsPerSample = 512;
  const double paths = tests::meanRadiance(makePathRenderer(scene, settings)->render(camera, 0)).y;
  EXPECT_NEAR(meanWithSolution(scene, camera, fewPaths()), paths, 0.02 * paths);
}

/// A ball on a floor under a sky, from either side.
Scene ballScene() {
  Scene scene = floorScene(tests::diffuseMaterial(Rgb(0.5f)));
  scene.materials.push_back(tests::diffuseMaterial(Rgb(0.8f)));
  tests::place(scene, tests::sphere({0, 0.5f, 0}, 0.5f, 24, 12, 1));
  scene.environment = tests::uniformSky(Rgb(1.0f));
  return scene;
}
const std::array<Camera, 2> kSides = {tests::lookingAt({0.0, 1.0, 3.0}, {0, 0.3, 0}, {32, 24}, 0.7),
                                      tests::lookingAt({0.0, 1.0, -3.0}, {0, 0.3, 0}, {32, 24}, 0.7)};

// A closed box without a floor of its own stands on one that goes on under its walls into daylight.
TEST(LightSolution, LeaksNothingUnderWallsWithoutThickness) {
  Scene scene = floorScene(tests::diffuseMaterial(Rgb(0.7f)));
  tests::place(scene, tests::quad({0, 0, 2}, {0, 2, 0}, {0, 0, -4}, 0));
  tests::place(scene, tests::quad({4, 0, 2}, {0, 2, 0}, {0, 0, -4}, 0));
  tests::place(scene, tests::quad({0, 0, 2}, {4, 0, 0}, {0, 2, 0}, 0));
  tests::place(scene, tests::quad({0, 0, -2}, {4, 0, 0}, {0, 2, 0}, 0));
  tests::place(scene, tests::quad({0, 2, 2}, {4, 0, 0}, {0, 0, -4}, 0));
  scene.environment = tests::uniformSky(Rgb(1.0f));
  const std::array cameras = {tests::lookingAt({-2, 1.5, 0}, {0, 0, 0}, {64, 48}, 0.9),
                              tests::lookingAt({2, 1.5, 0}, {0, 0, 0}, {64, 48}, 0.9)};
  PathSettings settings = fewPaths();
  settings.solution = solveLight(scene, settings, cameras, nullptr, {});
  const auto renderer = makePathRenderer(scene, settings);
  EXPECT_GT(tests::meanRadiance(renderer->render(cameras[0], 0)).y, 0.2);
  std::size_t walls = 0;
  for (std::size_t i = 0; i < settings.solution->fine.places().size(); ++i) {
    walls += settings.solution->fine.wallsOf(i).size();
  }
  EXPECT_GT(walls, 10u);
  const std::string bytes = toBytes(*settings.solution, "box");
  const auto again = lightSolutionFrom(bytes, "box");
  ASSERT_TRUE(again);
  EXPECT_EQ(toBytes(*again, "box"), bytes);
  // But for a hundredth of the reach behind the walls: 0.2 per cent of the daylight, 2.1 if records knew no
  // walls.
  EXPECT_LT(tests::meanRadiance(renderer->render(cameras[1], 0)).y, 1e-3);
}

TEST(LightSolution, ComesBackFromItsBytesAsItWas) {
  const Scene scene = ballScene();
  const auto solution = solveLight(scene, fewPaths(), std::span(kSides).first(1), nullptr, {});
  const std::string bytes = toBytes(*solution, "ball");
  const auto again = lightSolutionFrom(bytes, "ball");
  ASSERT_TRUE(again);
  EXPECT_EQ(toBytes(*again, "ball"), bytes);
  EXPECT_EQ(sizeOf(*again).records, sizeOf(*solution).records);
  EXPECT_EQ(sizeOf(*again).cameras, 1u);
  PathSettings before = fewPaths();
  before.solution = solution;
  PathSettings after = fewPaths();
  after.solution = again;
  const Frame a = makePathRenderer(scene, before)->render(kSides[0], 0);
  const Frame b = makePathRenderer(scene, after)->render(kSides[0], 0);
  EXPECT_THAT(b.diffuse.pixels(), testing::ElementsAreArray(a.diffuse.pixels()));
}

TEST(LightSolution, RefusesOtherAndDamagedBytes) {
  const auto solution = solveLight(ballScene(), fewPaths(), std::span(kSides).first(1), nullptr, {});
  const std::string bytes = toBytes(*solution, "ball");
  EXPECT_FALSE(lightSolutionFrom(bytes, "another ball"));
  EXPECT_FALSE(lightSolutionFrom("", "ball"));
  EXPECT_FALSE(lightSolutionFrom("PromenadeLight8\n", "ball"));
  for (const std::size_t length : {bytes.size() - 1, bytes.size() / 2, std::size_t{30}}) {
    EXPECT_FALSE(lightSolutionFrom(bytes.substr(0, length), "ball")) << length;
  }
  for (std::size_t i = 0; i < bytes.size(); i += bytes.size() / 37) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x40);
    EXPECT_FALSE(lightSolutionFrom(damaged, "ball")) << i;
  }
}

// Whose checksum is right, and whose contents are not.
TEST(LightSolution, RefusesContentsThatCannotBe) {
  LightSolution solution;
  const RecordWall wall{{-1, 0, 0}, -0.25f};
  solution.coarse.place({{0, 0, 0}, kUp, 1.0f}, std::span(&wall, 1));
  solution.coarse.setLight({lightOf(2.0f)}, {}, IrradianceRecords::Noise::kLeftIn);
  const std::string bytes = toBytes(solution, "box");
  // Signature, key with its length, number of cameras; then of coarse records, and whether they have
  // directions.
  constexpr std::size_t kCount = 16 + 8 + 3 + 8;
  constexpr std::size_t kRecord = kCount + 8 + 4;
  constexpr std::size_t kWalls = kRecord + 14 * sizeof(float);
  const auto with = [&bytes](std::size_t at, const auto& value) {
    std::string changed = bytes.substr(0, bytes.size() - sizeof(std::uint64_t));
    std::memcpy(changed.data() + at, &value, sizeof(value));
    const std::uint64_t checksum = fnv1a(std::as_bytes(std::span(changed)));
    changed.append(reinterpret_cast<const char*>(&checksum), sizeof(checksum));
    return changed;
  };
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  ASSERT_TRUE(lightSolutionFrom(with(kWalls, std::uint32_t{1}), "box"));
  EXPECT_FALSE(lightSolutionFrom(with(kCount, std::uint64_t{1} << 60), "box"));
  EXPECT_FALSE(lightSolutionFrom(with(kRecord, kNaN), "box"));
  EXPECT_FALSE(lightSolutionFrom(with(kWalls, std::uint32_t{0xffffffff}), "box"));
  EXPECT_FALSE(lightSolutionFrom(with(kWalls + 4, kNaN), "box"));
  EXPECT_FALSE(lightSolutionFrom(with(kWalls + 4 + 12, 0.25f), "box"));  // on the wrong side
}

TEST(LightSolution, IsExtendedOnlyForNewCameras) {
  const Scene scene = ballScene();
  const auto front = solveLight(scene, fewPaths(), std::span(kSides).first(1), nullptr, {});
  EXPECT_EQ(solveLight(scene, fewPaths(), std::span(kSides).first(1), front, {}), front);
  const auto both = solveLight(scene, fewPaths(), kSides, front, {});
  EXPECT_EQ(sizeOf(*both).cameras, 2u);
  EXPECT_GT(sizeOf(*both).records, sizeOf(*front).records);
  EXPECT_EQ(solveLight(scene, fewPaths(), kSides, both, {}), both);
}

TEST(LightSolution, IsTheSameForAnyNumberOfThreads) {
  Scene scene = floorScene(tests::diffuseMaterial(Rgb(0.5f)));
  scene.materials.push_back(tests::diffuseMaterial(Rgb(0.8f)));
  tests::place(scene, tests::sphere({0, 0.5f, 0}, 0.5f, 24, 12, 1));
  scene.environment = tests::uniformSky(Rgb(1.0f));
  const Camera camera = tests::lookingAt({0.0, 1.0, 3.0}, {0, 0.3, 0}, {32, 24}, 0.7);
  PathSettings one = fewPaths();
  one.threads = 1;
  PathSettings two = fewPaths();
  two.threads = 2;
  one.solution = solveLight(scene, one, std::span(&camera, 1), nullptr, {});
  two.solution = solveLight(scene, two, std::span(&camera, 1), nullptr, {});
  const Frame a = makePathRenderer(scene, one)->render(camera, 0);
  const Frame b = makePathRenderer(scene, two)->render(camera, 0);
  for (std::size_t i = 0; i < a.diffuse.pixels().size(); ++i) {
    ASSERT_EQ(a.diffuse.pixels()[i], b.diffuse.pixels()[i]) << i;
    ASSERT_EQ(a.viewDependent.pixels()[i], b.viewDependent.pixels()[i]) << i;
  }
}

TEST(LightSolver, LevelByLevelMakesTheSameAsAllAtOnce) {
  const Scene scene = ballScene();
  const auto cameras = std::span(kSides).first(1);
  const auto whole = solveLight(scene, fewPaths(), cameras, nullptr, {});
  const auto solver = makeLightSolver(scene, fewPaths(), cameras, nullptr);
  std::size_t records = 0;
  while (solver->levelsLeft() > 0) {
    // Not for the camera before it is done.
    EXPECT_EQ(sizeOf(*solver->solution()).cameras, 0u);
    EXPECT_GE(solver->place(), solver->place());  // once is enough
    solver->gather({}, {});
    EXPECT_GE(sizeOf(*solver->solution()).records, records);
    records = sizeOf(*solver->solution()).records;
  }
  EXPECT_EQ(toBytes(*solver->solution(), "ball"), toBytes(*whole, "ball"));
  EXPECT_EQ(makeLightSolver(scene, fewPaths(), cameras, whole)->levelsLeft(), 0);
}

TEST(LightSolver, GoesOnAfterAnInterruptionAsIfThereHadBeenNone) {
  const Scene scene = ballScene();
  const auto cameras = std::span(kSides).first(1);
  struct Enough {};
  const auto solver = makeLightSolver(scene, fewPaths(), cameras, nullptr);
  while (solver->levelsLeft() > 0) {
    const int left = solver->levelsLeft();
    if (solver->place() > 0) {
      EXPECT_THROW(solver->gather([](const Progress&) { throw Enough(); }, {}), Enough);
    }
    EXPECT_EQ(solver->levelsLeft(), left);
    // What was placed and has no light is nothing to whoever renders.
    PathSettings settings = fewPaths();
    settings.solution = solver->solution();
    EXPECT_GT(tests::meanRadiance(makePathRenderer(scene, settings)->render(kSides[0], 0)).y, 0.1);
    solver->gather({}, {});
  }
  EXPECT_EQ(toBytes(*solver->solution(), "ball"),
            toBytes(*solveLight(scene, fewPaths(), cameras, nullptr, {}), "ball"));
}

}  // namespace
}  // namespace promenade::render
