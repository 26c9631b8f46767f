// Radiosity and path tracing must agree on diffuse scenes: two solvers that have nothing in common but the
// scene.

#include "tests/render/radiosity.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "src/render/path_tracer.h"
#include "tests/render/scenes.h"

namespace promenade::render {
namespace {

using tests::Patch;
using tests::Radiosity;

/// The box [-1, 1]^3, fronts inward, a mesh a side: floor, ceiling, left, right, back, front.
Scene box(const std::array<Material, 6>& sides) {
  Scene scene;
  scene.materials.assign(sides.begin(), sides.end());
  tests::place(scene, tests::quad({-1, -1, 1}, {2, 0, 0}, {0, 0, -2}, 0));
  tests::place(scene, tests::quad({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, 1));
  tests::place(scene, tests::quad({-1, -1, 1}, {0, 0, -2}, {0, 2, 0}, 2));
  tests::place(scene, tests::quad({1, -1, -1}, {0, 0, 2}, {0, 2, 0}, 3));
  tests::place(scene, tests::quad({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, 4));
  tests::place(scene, tests::quad({1, -1, 1}, {-2, 0, 0}, {0, 2, 0}, 5));
  return scene;
}

Rgb meanRadiance(const std::vector<Patch>& patches) {
  Rgb sum(0.0f);
  float area = 0.0f;
  for (const Patch& patch : patches) {
    sum += patch.radiance * patch.area;
    area += patch.area;
  }
  return sum / area;
}

/// The same patches' mean by path tracing, at the centre of each.
Rgb meanByPaths(const PathTracer& tracer, const std::vector<Patch>& patches, const Rgb& emission, int paths) {
  Rgb sum(0.0f);
  float area = 0.0f;
  Sampler::Stream stream;
  PathRays rays;
  for (const Patch& patch : patches) {
    stream.pixel.x += 1;
    const SurfaceLight light =
        tracer.gather(patch.centre(), patch.normal, stream, {paths, 4 * paths}, rays).light;
    sum += (emission + patch.reflectance * light.radiance) * patch.area;
    area += patch.area;
  }
  return sum / area;
}

void expectWithin(double percent, const Rgb& found, const Rgb& expected) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / expected[c], 1.0, percent / 100.0) << "channel " << c;
}

TEST(Radiosity, OfAClosedBoxThatShinesEverywhereIsEmissionOverAbsorption) {
  // Every patch sees the same everywhere: L = e + a L.
  Material side = tests::diffuseMaterial({0.5f, 0.6f, 0.2f});
  side.emission = Rgb(1.0f, 0.5f, 2.0f);
  std::array<Material, 6> sides;
  sides.fill(side);
  const Scene scene = tests::mattMesh(box(sides), 0.6f);
  const PathTracer tracer(scene, {});
  Radiosity radiosity(tracer.surfaces(), tracer.embree());
  radiosity.shoot(1e-3, 256);
  const Rgb expected(1.0f / 0.5f, 0.5f / 0.4f, 2.0f / 0.8f);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    expectWithin(1.0, meanRadiance(radiosity.patches(i)), expected);
    for (const Patch& patch : radiosity.patches(i)) expectWithin(12.0, patch.radiance, expected);
  }
}

TEST(Radiosity, AgreesWithPathTracingInAClosedRoomWithALamp) {
  const Material white = tests::diffuseMaterial(Rgb(0.6f));
  const Material red = tests::diffuseMaterial({0.6f, 0.1f, 0.1f});
  const Material green = tests::diffuseMaterial({0.1f, 0.5f, 0.1f});
  Scene room = box({white, white, red, green, white, white});
  room.materials.push_back(tests::emitter({8.0f, 7.0f, 6.0f}));
  tests::place(room, tests::quad({-0.4f, 0.99f, -0.4f}, {0.8f, 0, 0}, {0, 0, 0.8f}, 6));  // shines downward
  const Scene scene = tests::mattMesh(room, 0.3f);
  const PathTracer tracer(scene, {.maxBounces = 32});
  Radiosity radiosity(tracer.surfaces(), tracer.embree());
  radiosity.shoot(2e-3, 256);
  for (std::size_t i = 0; i < 6; ++i) {
    if (i == 1) continue;  // the ceiling is in part above the lamp
    SCOPED_TRACE(i);
    expectWithin(2.0, meanRadiance(radiosity.patches(i)),
                 meanByPaths(tracer, radiosity.patches(i), Rgb(0.0f), 64));
  }
}

}  // namespace
}  // namespace promenade::render
