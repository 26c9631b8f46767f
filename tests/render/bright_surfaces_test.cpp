// Bright surfaces as lights: a small patch over which a room is lit, with the light that falls on it given.

#include "src/render/bright_surfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "src/render/irradiance_solution.h"
#include "src/render/path_tracer.h"
#include "tests/render/gathering.h"
#include "tests/render/scenes.h"

namespace promenade::render {
namespace {

using tests::kUp;
const glm::vec3 kAbove(0.0f, 1.0f, 0.0f);

/// A patch of 0.2 m by 0.2 m that shines upward from the origin, and a dark floor of 2 m by 2 m beside it.
Scene patchScene() {
  Scene scene;
  scene.materials.push_back(tests::diffuseMaterial(Rgb(0.5f)));
  tests::place(scene, tests::quad({-0.1f, 0, 0.1f}, {0.2f, 0, 0}, {0, 0, -0.2f}, 0));
  tests::place(scene, tests::quad({0.7f, 0, 1.0f}, {2.0f, 0, 0}, {0, 0, -2.0f}, 0));
  return scene;
}

/// A white surface on the patch would have radiance 100, one on the floor 0.001.
std::shared_ptr<const LightSolution> patchLight() {
  LightSolution solution;
  solution.coarse.place({{0, 0, 0}, kUp, 0.5f});
  solution.coarse.place({{1.7f, 0, 0}, kUp, 1.5f});
  const glm::vec3 mean = (2.0f / 3.0f) * kUp;
  solution.coarse.setLight({{Rgb(100.0f), mean}, {Rgb(0.001f), mean}});
  return std::make_shared<const LightSolution>(std::move(solution));
}

struct Patch {
  Scene scene = patchScene();
  PathTracer tracer{scene, PathSettings{}};
  Patch() { tracer.setSolution(patchLight()); }
};

TEST(BrightSurfaces, AreThoseThatSendOnFarMoreThanTheRest) {
  const Patch patch;
  const auto bright = patch.tracer.findBright();
  ASSERT_FALSE(bright->empty());
  // 100 * 0.04 m2 against 0.001 * 4 m2.
  EXPECT_GT(bright->share(), 0.99f);
  EXPECT_LT(bright->share(), 1.0f);
  Hit onPatch{0, 0, {0.3f, 0.3f}, 1.0f};
  EXPECT_GT(bright->pdf(onPatch, -kUp, 1.0f, kAbove, -kUp), 0.0f);
  EXPECT_EQ(bright->pdf(onPatch, kUp, 1.0f, -kAbove, kUp), 0.0f);  // its back is dark
  onPatch.instance = 1;
  EXPECT_EQ(bright->pdf(onPatch, -kUp, 1.0f, kAbove, -kUp), 0.0f);
}

TEST(BrightSurfaces, AreNoneWhereAllIsAlike) {
  Scene scene = patchScene();
  PathTracer tracer(scene, PathSettings{});
  LightSolution solution;
  solution.coarse.place({{1.0f, 0, 0}, kUp, 5.0f});
  solution.coarse.setLight({{Rgb(1.0f), kUp}});
  tracer.setSolution(std::make_shared<const LightSolution>(std::move(solution)));
  EXPECT_TRUE(tracer.findBright()->empty());
}

TEST(BrightSurfaces, AreChosenWithTheDensityTheyAreFoundWith) {
  const Patch patch;
  const auto bright = patch.tracer.findBright();
  constexpr int kSide = 32;
  double solidAngle = 0.0;
  for (int i = 0; i < kSide * kSide; ++i) {
    // A (0, 2)-like set: choose runs through all pieces while u covers each of them.
    const float choose = (static_cast<float>(i) + 0.5f) / (kSide * kSide);
    const glm::vec2 u(std::fmod(static_cast<float>(i) * 0.754877666f, 1.0f),
                      std::fmod(static_cast<float>(i) * 0.569840296f, 1.0f));
    const auto chosen = bright->sample(kAbove, -kUp, choose, u);
    ASSERT_TRUE(chosen) << i;
    Ray ray;
    ray.origin = kAbove;
    ray.direction = chosen->direction;
    const Hit found = patch.tracer.embree().intersect(ray);
    ASSERT_EQ(found.instance, chosen->hit.instance) << i;
    ASSERT_NEAR(found.distance, chosen->hit.distance, 1e-4f) << i;
    ASSERT_NEAR(bright->pdf(chosen->hit, chosen->direction, chosen->hit.distance, kAbove, -kUp) / chosen->pdf,
                1.0f, 1e-4f)
        << i;
    solidAngle += 1.0 / chosen->pdf / (kSide * kSide);
  }
  // The mean of 1 / density is the solid angle of all that is chosen: of a square of half side a at distance
  // h, 4 atan(a^2 / (h sqrt(2 a^2 + h^2))).
  EXPECT_NEAR(solidAngle, 4.0 * std::atan(0.01 / std::sqrt(1.02)), 4e-4);
}

TEST(BrightSurfaces, MakeThePatchAsBrightAsItIsWithATenthOfTheNoise) {
  Patch patch;
  const tests::Spread byChance = tests::gatherOften(patch.tracer, kAbove, -kUp, 64);
  patch.tracer.setBright(patch.tracer.findBright());
  const tests::Spread asLights = tests::gatherOften(patch.tracer, kAbove, -kUp, 64);
  // Form factor of a square of half side a, seen from height h above its middle, X = a / h: four times
  // X / (pi sqrt(1 + X^2)) atan(X / sqrt(1 + X^2)) = 0.012565; times albedo 0.5 and radiance 100. Of the dark
  // floor comes less than 0.0005.
  const double root = std::sqrt(1.01);
  const double expected = 50.0 * 4.0 * 0.1 / (tests::kPi * root) * std::atan(0.1 / root);
  // 3.2 of 256 paths find the patch by chance: +-55% if they were independent, of 64 means 7%.
  EXPECT_NEAR(byChance.mean, expected, 0.2 * expected);
  EXPECT_GT(byChance.deviation, 0.2);
  EXPECT_LT(byChance.deviation, 0.6 * 0.55);  // stratified
  EXPECT_NEAR(asLights.mean, expected, 0.01 * expected);
  EXPECT_LT(asLights.deviation, 0.07 * 0.55);
}

}  // namespace
}  // namespace promenade::render
