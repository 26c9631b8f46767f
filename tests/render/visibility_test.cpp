// What the primary rays of PathRenderer see.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "src/core/errors.h"
#include "src/render/path_renderer.h"
#include "tests/render/scenes.h"

namespace promenade::render {
namespace {

using tests::lookingAt;

Scene wallAtDepth(float depth) {
  Scene scene;
  scene.materials.push_back(tests::diffuseMaterial(Rgb(0.5f)));
  tests::place(scene, tests::quad({-100.0f, -100.0f, -depth}, {200.0f, 0.0f, 0.0f}, {0.0f, 200.0f, 0.0f}, 0));
  return scene;
}

TEST(Visibility, DepthOfAWallAcrossTheViewIsTheSameInEverySample) {
  // Depth is measured along the view axis, so a plane at right angles to it has one depth, here 7 m.
  const Scene scene = wallAtDepth(7.0f);
  const auto renderer = makePathRenderer(scene, {});
  for (const Size size : {Size{1, 1}, Size{3, 1}, Size{17, 5}, Size{37, 23}}) {
    const Visibility v = renderer->visibility(lookingAt({0, 0, 0}, {0, 0, -1}, size, 1.2));
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        EXPECT_NEAR(v.depth(x, y), 7.0f, 7e-6f);
        EXPECT_EQ(v.item(x, y), 1u);
        EXPECT_NEAR(v.normal(x, y).z, 1.0f, 1e-6f);
      }
    }
  }
}

TEST(Visibility, NormalsFaceTheCameraOnBothSidesOfASurface) {
  const Scene scene = wallAtDepth(2.0f);
  const auto renderer = makePathRenderer(scene, {});
  const Visibility front = renderer->visibility(lookingAt({0, 0, 0}, {0, 0, -2}, {5, 5}));
  const Visibility back = renderer->visibility(lookingAt({0, 0, -4}, {0, 0, -2}, {5, 5}));
  EXPECT_NEAR(front.normal(2, 2).z, 1.0f, 1e-6f);
  EXPECT_NEAR(back.normal(2, 2).z, -1.0f, 1e-6f);
}

TEST(Visibility, NormalsOfMillimetresFarAwayAreGood) {
  // A square of 1 mm, 20 m away. Its edges may be found as differences of corners as seen from the eye, which
  // are rounded to 2^-20 m = 1e-6 m: each end is at most half of that off, so an edge turns by at most 1e-3,
  // the normal of two edges by 1.5e-3.
  Scene scene;
  scene.materials.push_back(tests::diffuseMaterial(Rgb(0.5f)));
  tests::place(scene, tests::quad({-5e-4f, -4e-4f, -3e-4f}, {1e-3f, 0.0f, 0.0f}, {0.0f, 8e-4f, 6e-4f}, 0));
  const Visibility v =
      makePathRenderer(scene, {})->visibility(lookingAt({0, 0, 20}, {0, 0, 0}, {9, 9}, 3e-5));
  for (const glm::vec3& normal : v.normal.pixels()) {
    EXPECT_LT(glm::length(normal - glm::vec3(0.0f, -0.6f, 0.8f)), 1.5e-3f);
  }
}

TEST(Visibility, OfASphereIsExactUpToItsFacets) {
  Scene scene;
  scene.materials.push_back(tests::diffuseMaterial(Rgb(0.5f)));
  tests::place(scene, tests::sphere({0.0f, 0.0f, -5.0f}, 1.0f, 512, 256, 0));
  const auto renderer = makePathRenderer(scene, {});
  const Camera camera = lookingAt({0, 0, 0}, {0, 0, -1}, {33, 33}, 0.5);
  const Visibility v = renderer->visibility(camera);
  // Facets of angle 2 pi/512 lie at most 1 - cos(pi/512) = 1.9e-5 of the radius inside the sphere; toward the
  // silhouette that is divided by the cosine, so samples that see the surface at a cosine below 0.3 are left
  // out.
  int compared = 0;
  for (int y = 0; y < 33; ++y) {
    for (int x = 0; x < 33; ++x) {
      const glm::dvec3 d = camera.direction({x + 0.5, y + 0.5});
      const glm::dvec3 c(0, 0, -5);
      const double a = glm::dot(d, d), b = glm::dot(d, c), q = b * b - a * (25.0 - 1.0);
      if (q <= 0.0) {
        if (q < -0.05) {
          EXPECT_EQ(v.item(x, y), kNoItem);
          EXPECT_TRUE(std::isinf(v.depth(x, y)));
          EXPECT_EQ(v.normal(x, y), glm::vec3(0.0f));
        }
        continue;
      }
      const double depth = (b - std::sqrt(q)) / a;
      const glm::dvec3 normal = depth * d - c;
      if (-glm::dot(normal, d) / std::sqrt(a) < 0.3) continue;
      ++compared;
      EXPECT_NEAR(v.depth(x, y), depth, 2e-4);
      EXPECT_GT(glm::dot(glm::dvec3(v.normal(x, y)), normal), std::cos(0.02));
      EXPECT_EQ(v.item(x, y), 1u);
    }
  }
  EXPECT_GT(compared, 100);
}

/// Fifty-facet spheres at several places, scaled, turned and mirrored; shared by one mesh or each its own.
Scene spheres(bool shared) {
  Scene scene;
  scene.materials.push_back(tests::diffuseMaterial(Rgb(0.7f)));
  const Mesh mesh = tests::sphere({0.1f, 0.2f, -0.1f}, 1.0f, 10, 6, 0);
  if (shared) scene.meshes.push_back(mesh);
  for (int i = 0; i < 5; ++i) {
    const auto k = static_cast<float>(i);
    glm::mat4 m = glm::translate(glm::mat4(1.0f), glm::vec3(k - 2.0f, 0.3f * k - 0.5f, -6.0f - k));
    m = glm::rotate(m, 0.7f * k, glm::normalize(glm::vec3(1.0f, 2.0f, k)));
    m = glm::scale(m, glm::vec3(i == 2 ? -0.9f : 0.6f, 0.5f + 0.1f * k, 0.8f));
    if (!shared) scene.meshes.push_back(mesh);
    Instance instance;
    instance.mesh = shared ? 0 : i;
    instance.worldFromObject = glm::mat4x3(m);
    scene.instances.push_back(instance);
  }
  scene.environment = tests::uniformSky(Rgb(1.0f, 0.8f, 0.5f));
  return scene;
}

TEST(Visibility, OfInstancesEqualsThatOfFlattenedMeshes) {
  const Scene shared = spheres(true);
  const Scene flattened = spheres(false);
  const Camera camera = lookingAt({0, 0, 0}, {0, 0, -1}, {61, 47}, 0.9);
  const Visibility a = makePathRenderer(shared, {})->visibility(camera);
  const Visibility b = makePathRenderer(flattened, {})->visibility(camera);
  int different = 0;  // rays through an edge may fall on either side of it
  int hits = 0;
  for (int y = 0; y < 47; ++y) {
    for (int x = 0; x < 61; ++x) {
      if (a.item(x, y) != b.item(x, y) ||
          (a.item(x, y) != kNoItem && std::abs(a.depth(x, y) - b.depth(x, y)) > 1e-4f) ||
          glm::length(a.normal(x, y) - b.normal(x, y)) > 1e-3f) {
        ++different;
      }
      hits += a.item(x, y) != kNoItem ? 1 : 0;
    }
  }
  EXPECT_GT(hits, 200);
  EXPECT_LE(different, 3);
}

TEST(Visibility, RadianceOfInstancesEqualsThatOfFlattenedMeshes) {
  const Scene shared = spheres(true);
  const Scene flattened = spheres(false);
  PathSettings settings;
  settings.pathsPerSample = 64;
  const Camera camera = lookingAt({0, 0, 0}, {0, 0, -1}, {61, 47}, 0.9);
  const glm::dvec3 a = tests::meanRadiance(makePathRenderer(shared, settings)->render(camera, 0));
  const glm::dvec3 b = tests::meanRadiance(makePathRenderer(flattened, settings)->render(camera, 0));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 2e-3);
}

TEST(Visibility, OfAnEmptySceneIsBackground) {
  Scene scene;
  scene.materials.emplace_back();
  const auto renderer = makePathRenderer(scene, {});
  const Visibility v = renderer->visibility(lookingAt({0, 0, 0}, {0, 0, -1}, {3, 2}));
  for (const ItemId item : v.item.pixels()) EXPECT_EQ(item, kNoItem);
  for (const float depth : v.depth.pixels()) EXPECT_TRUE(std::isinf(depth));
  const Frame frame = renderer->render(v.camera, 0);
  for (const Rgb& radiance : frame.diffuse.pixels()) EXPECT_EQ(radiance, Rgb(0.0f));
}

TEST(Visibility, SettingsOutOfRangeAreNamed) {
  const Scene scene = wallAtDepth(1.0f);
  PathSettings settings;
  settings.pathsPerSample = 0;
  EXPECT_THROW(static_cast<void>(makePathRenderer(scene, settings)), InputError);
  settings = {};
  settings.maxBounces = -1;
  EXPECT_THROW(static_cast<void>(makePathRenderer(scene, settings)), InputError);
}

TEST(Visibility, CheckpointMayInterruptTheWork) {
  const Scene scene = wallAtDepth(1.0f);
  PathSettings settings;
  settings.checkpoint = [] { throw Interrupted(); };
  const auto renderer = makePathRenderer(scene, settings);
  EXPECT_THROW(static_cast<void>(renderer->render(lookingAt({0, 0, 0}, {0, 0, -1}, {64, 64}), 0)),
               Interrupted);
}

}  // namespace
}  // namespace promenade::render
