// Directions toward the visible sky.

#include "src/render/sky_guide.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "src/render/surfaces.h"
#include "tests/render/scenes.h"

namespace promenade::render {
namespace {

/// A box of 10 m with one open side, +X.
struct Room {
  Scene scene;
  Room() {
    scene.materials.push_back(tests::diffuseMaterial(Rgb(0.5f)));
    const glm::vec3 x(10, 0, 0), y(0, 10, 0), z(0, 0, 10);
    tests::place(scene, tests::quad({0, 0, 0}, x, z, 0));
    tests::place(scene, tests::quad(y, x, z, 0));
    tests::place(scene, tests::quad({0, 0, 0}, x, y, 0));
    tests::place(scene, tests::quad(z, x, y, 0));
    tests::place(scene, tests::quad({0, 0, 0}, y, z, 0));
    scene.environment = tests::uniformSky(Rgb(3.0f));
  }
};

TEST(SkyGuide, DensityIsThatOfTheSamplesAndSumsToOne) {
  const Room room;
  const Surfaces surfaces(room.scene);
  const EmbreeScene embree(surfaces, 1);
  const EnvironmentLight environment(*room.scene.environment);
  const SkyGuide guide(embree, environment);
  const SkyGuide::View& view = guide.viewFrom({2.0f, 0.0f, 5.0f}, {0.0f, 1.0f, 0.0f});
  EXPECT_GT(view.share, 0.5f);  // most of the sphere is walls
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  // The mean of 1/pdf over the samples is the solid angle where the density is not 0: the sphere, because the
  // environment's own density is in the mixture; and the mean of pdf over uniform directions times 4 pi is 1.
  double inverse = 0.0, total = 0.0;
  constexpr int kCount = 200000;
  for (int i = 0; i < kCount; ++i) {
    const EnvironmentSample s = guide.sample(view, unit(random), {unit(random), unit(random)});
    ASSERT_NEAR(glm::length(s.direction), 1.0f, 1e-5f);
    ASSERT_NEAR(s.pdf, guide.toward(view, s.direction).pdf, 1e-6f * s.pdf);
    inverse += 1.0 / s.pdf;
    const float height = 2.0f * unit(random) - 1.0f, turn = 6.2831853f * unit(random);
    const float radius = std::sqrt(1.0f - height * height);
    total += guide.toward(view, {radius * std::cos(turn), height, radius * std::sin(turn)}).pdf;
  }
  EXPECT_NEAR(inverse / kCount, 4.0 * tests::kPi, 0.15);
  EXPECT_NEAR(total / kCount * 4.0 * tests::kPi, 1.0, 0.03);
}

TEST(SkyGuide, SendsMostRaysThroughTheOpening) {
  const Room room;
  const Surfaces surfaces(room.scene);
  const EmbreeScene embree(surfaces, 1);
  const EnvironmentLight environment(*room.scene.environment);
  const SkyGuide guide(embree, environment);
  const glm::vec3 position(1.0f, 0.001f, 5.0f);
  const SkyGuide::View& view = guide.viewFrom(position, {0.0f, 1.0f, 0.0f});
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  int guided = 0, plain = 0;
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    Ray ray;
    ray.origin = position;
    ray.direction = guide.sample(view, unit(random), {unit(random), unit(random)}).direction;
    guided += embree.transmittance(ray).x > 0.0f ? 1 : 0;
    ray.direction = environment.sample({unit(random), unit(random)}).direction;
    plain += embree.transmittance(ray).x > 0.0f ? 1 : 0;
  }
  EXPECT_GT(guided, 5 * plain);
  EXPECT_GT(guided, kCount / 2);
}

TEST(SkyGuide, KeepsToTheEnvironmentWhereNoSkyIsSeen) {
  Room room;
  tests::place(room.scene, tests::quad({10, 0, 0}, {0, 10, 0}, {0, 0, 10}, 0));  // closes the box
  const Surfaces surfaces(room.scene);
  const EmbreeScene embree(surfaces, 1);
  const EnvironmentLight environment(*room.scene.environment);
  const SkyGuide guide(embree, environment);
  const SkyGuide::View& view = guide.viewFrom({5.0f, 2.0f, 5.0f}, {0.0f, 1.0f, 0.0f});
  EXPECT_EQ(view.share, 0.0f);
  const glm::vec3 up(0.0f, 1.0f, 0.0f);
  EXPECT_EQ(guide.toward(view, up).pdf, environment.toward(up).pdf);
}

TEST(SkyGuide, SeesASmallWindowFromDeepInTheRoom) {
  // A metre of sky, 9 m away: less than a bin.
  Room room;
  const float low = 4.5f, high = 5.5f;
  tests::place(room.scene, tests::quad({10, 0, 0}, {0, low, 0}, {0, 0, 10}, 0));
  tests::place(room.scene, tests::quad({10, high, 0}, {0, 10 - high, 0}, {0, 0, 10}, 0));
  tests::place(room.scene, tests::quad({10, low, 0}, {0, high - low, 0}, {0, 0, low}, 0));
  tests::place(room.scene, tests::quad({10, low, high}, {0, high - low, 0}, {0, 0, 10 - high}, 0));
  const Surfaces surfaces(room.scene);
  const EmbreeScene embree(surfaces, 1);
  const EnvironmentLight environment(*room.scene.environment);
  const SkyGuide guide(embree, environment);
  // Not from everywhere, for a bin is looked at by a few rays only, but from nearly everywhere.
  int found = 0, asked = 0;
  for (float y = 0.1f; y < 10.0f; y += 0.5f) {
    for (float z = 0.1f; z < 10.0f; z += 0.5f) {
      const glm::vec3 position(1.0f, y, z);
      const glm::vec3 toward = glm::normalize(glm::vec3(10.0f, 5.0f, 5.0f) - position);
      const SkyGuide::View& view = guide.viewFrom(position, {1.0f, 0.0f, 0.0f});
      found += guide.toward(view, toward).pdf > 2.0f * environment.toward(toward).pdf ? 1 : 0;
      ++asked;
    }
  }
  EXPECT_GT(found, asked * 3 / 4);
}

/// A sky with a sun of 3 degrees around a pixel, which sends 20 times as much light as all the rest.
Environment skyWithSun(int column, int row) {
  Environment sky;
  sky.radiance = RadianceMap({256, 128}, Rgb(1.0f));
  for (int y = row; y < row + 2; ++y) {
    for (int x = column; x < column + 2; ++x) sky.radiance(x, y) = Rgb(1e5f);
  }
  return sky;
}

TEST(SkyGuide, LeavesToTheEnvironmentWhatArrives) {
  const auto share = [](int column, int row, const glm::vec3& position, const glm::vec3& normal) {
    Room room;
    room.scene.environment = skyWithSun(column, row);
    const Surfaces surfaces(room.scene);
    const EmbreeScene embree(surfaces, 1);
    const EnvironmentLight environment(*room.scene.environment);
    return SkyGuide(embree, environment).viewFrom(position, normal).share;
  };
  // The sun stands before the open side, three quarters along the image, or above the ceiling.
  EXPECT_LT(share(191, 63, {5.0f, 5.0f, 5.0f}, {1.0f, 0.0f, 0.0f}), 0.3f);
  EXPECT_GT(share(191, 20, {5.0f, 5.0f, 5.0f}, {1.0f, 0.0f, 0.0f}), 0.8f);
}

TEST(SkyGuide, IsTheSameInWhateverOrderItIsAsked) {
  Room room;
  room.scene.environment = skyWithSun(191, 63);
  const Surfaces surfaces(room.scene);
  const EmbreeScene embree(surfaces, 1);
  const EnvironmentLight environment(*room.scene.environment);
  const SkyGuide one(embree, environment);
  const SkyGuide other(embree, environment);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> along(0.0f, 10.0f);
  std::vector<glm::vec3> positions(200);
  for (glm::vec3& p : positions) p = {along(random), along(random), along(random)};
  const glm::vec3 up(0.0f, 1.0f, 0.0f);
  for (const glm::vec3& p : positions) (void)one.viewFrom(p, up);
  for (auto p = positions.rbegin(); p != positions.rend(); ++p) (void)other.viewFrom(*p, up);
  for (const glm::vec3& p : positions) {
    EXPECT_EQ(one.viewFrom(p, up).share, other.viewFrom(p, up).share);
    EXPECT_EQ(one.viewFrom(p, up).cumulative, other.viewFrom(p, up).cumulative);
  }
}

}  // namespace
}  // namespace promenade::render
