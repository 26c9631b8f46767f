// How a record's light is gathered: what error is stated, and what is done about it. The scenes send back
// light that is known in closed form.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "src/render/irradiance_solution.h"
#include "src/render/path_tracer.h"
#include "tests/render/scenes.h"

namespace promenade::render {
namespace {

using tests::kUp;

/// A place 1 m above a floor that fills its view. Each half of the floor, left and right of the place, sends
/// back its albedo: the light is the mean of both.
struct HalvedFloor {
  Scene scene;
  std::unique_ptr<PathTracer> tracer;

  HalvedFloor(float left, float right) {
    scene.materials = {tests::diffuseMaterial(Rgb(left)), tests::diffuseMaterial(Rgb(right))};
    // The line between them runs askew, so that it does not lie along the strata.
    const glm::vec3 across(std::cos(0.5f), 0.0f, std::sin(0.5f)), along(-across.z, 0.0f, across.x);
    tests::place(scene, tests::quad(-2e3f * (across + along), 2e3f * across, 4e3f * along, 0));
    tests::place(scene, tests::quad(-2e3f * along, 2e3f * across, 4e3f * along, 1));
    tracer = std::make_unique<PathTracer>(scene, PathSettings{});
    LightSolution solution;
    solution.fine.place({{0, 0, 0}, kUp, 1e4f});
    solution.fine.setLight({{Rgb(1.0f), (2.0f / 3.0f) * kUp}});
    tracer->setSolution(std::make_shared<const LightSolution>(std::move(solution)));
  }
};

struct Often {
  double mean = 0.0, deviation = 0.0;
  double stated = 0.0;  ///< standard error, root mean square
  double rays = 0.0;    ///< of each
};

/// The same for so many seeds.
Often gatherOften(const HalvedFloor& floor, const GatherEffort& effort, int times) {
  double sum = 0.0, squares = 0.0, stated = 0.0;
  PathRays rays;
  for (int i = 0; i < times; ++i) {
    Sampler::Stream numbers;
    numbers.seed = static_cast<std::uint32_t>(i);
    const SurfaceLight light = floor.tracer->gather({0, 1, 0}, -kUp, numbers, effort, rays).light;
    sum += light.radiance.g;
    squares += double{light.radiance.g} * light.radiance.g;
    stated += double{light.error} * light.error;
  }
  const double mean = sum / times;
  return {mean, std::sqrt(std::max(0.0, squares / times - mean * mean)), std::sqrt(stated / times),
          static_cast<double>(rays.scattered) / times};
}

TEST(Gathering, StatesMoreThanTheErrorItHasAndLessThanThatOfIndependentPaths) {
  // Half of the paths find 0.2 and half 0.8, each 0.3 from the mean: of 256 independent ones the mean would
  // be uncertain by a sixteenth of that (and more, for the weights of paths scatter).
  constexpr double kIndependent = 0.3 / 16.0;
  const Often found = gatherOften({0.2f, 0.8f}, {.paths = 256}, 64);
  EXPECT_GT(found.stated, found.deviation);
  EXPECT_LT(found.stated, 0.65 * kIndependent);
  EXPECT_LT(found.deviation, 0.3 * kIndependent);
}

TEST(Gathering, EndsWithFewPathsWhereTheyAgreeAndGoesOnWhereTheyDoNot) {
  constexpr GatherEffort kEffort{.paths = 64, .most = 4096, .relativeError = 0.01f};
  const Often uniform = gatherOften({0.5f, 0.5f}, kEffort, 32);
  const Often halved = gatherOften({0.1f, 0.9f}, kEffort, 32);
  EXPECT_GT(halved.rays, 2.0 * uniform.rays);
  EXPECT_LT(halved.rays, 4000.0);
  EXPECT_LE(uniform.stated, 0.01 * uniform.mean);
  EXPECT_LE(halved.stated, 0.01 * halved.mean);
}

TEST(Gathering, SpendsNoMoreThanItMay) {
  const Often found = gatherOften({0.1f, 0.9f}, {.paths = 64, .most = 300, .relativeError = 0.0f}, 4);
  EXPECT_EQ(found.rays, 256.0);  // 64, twice doubled: 512 would be too many
  EXPECT_EQ(gatherOften({0.1f, 0.9f}, {.paths = 64}, 4).rays, 64.0);
}

TEST(Gathering, IsRightOnAverageThoughItEndsWhereItSeemsRight) {
  const Often found = gatherOften({0.1f, 0.9f}, {.paths = 64, .most = 4096, .relativeError = 0.01f}, 128);
  const double expected = 0.5;
  EXPECT_NEAR(found.mean, expected, 4.0 * found.deviation / std::sqrt(128.0) + 0.001 * expected);
}

}  // namespace
}  // namespace promenade::render
