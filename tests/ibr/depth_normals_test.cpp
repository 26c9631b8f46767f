#include "ibr/depth_normals.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/ibr/maps.h"

namespace promenade::ibr {
namespace {

using tests::kInfinitelyFar;

// Depth of the plane through `point` with this normal, world axes.
DepthMap planeDepth(const Camera& camera, const glm::dvec3& point, const glm::dvec3& normal) {
  DepthMap depth(camera.size());
  for (int y = 0; y < depth.height(); ++y) {
    for (int x = 0; x < depth.width(); ++x) {
      const glm::dvec3 ray = camera.direction({x + 0.5, y + 0.5});
      const double z = glm::dot(point - camera.pose().eye, normal) / glm::dot(ray, normal);
      depth(x, y) = z > 0.0 ? static_cast<float>(z) : kInfinitelyFar;
    }
  }
  return depth;
}

TEST(DepthNormals, OfAPlaneAreItsNormal) {
  const Camera camera(Pose{}, 1.0, Size{31, 17});
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, 0.5, 0.8));
  const NormalMap normals = normalsOf(planeDepth(camera, {0.0, 0.0, -5.0}, normal), camera);
  for (const glm::vec3& n : normals.pixels()) {
    // Depth is rounded to 2^-24 of itself, tangents are about 1/20 of it long.
    EXPECT_NEAR(glm::dot(n, glm::vec3(normal)), 1.0f, 1e-4f);
  }
}

TEST(DepthNormals, AreNotTakenAcrossADepthEdge) {
  const Camera camera(Pose{}, 1.0, Size{20, 10});
  DepthMap depth(camera.size(), 4.0f);  // a wall that faces the eye
  for (int y = 0; y < 10; ++y) {
    for (int x = 10; x < 20; ++x) depth(x, y) = 8.0f;  // and one behind it
  }
  const NormalMap normals = normalsOf(depth, camera);
  for (const glm::vec3& n : normals.pixels()) EXPECT_NEAR(n.z, 1.0f, 1e-5f);
}

TEST(DepthNormals, FaceTheEyeWhereNothingElseIsKnown) {
  const Camera camera(Pose{}, 1.0, Size{3, 3});
  DepthMap depth(camera.size(), kInfinitelyFar);
  depth(1, 1) = 2.0f;
  const NormalMap normals = normalsOf(depth, camera);
  EXPECT_FLOAT_EQ(normals(1, 1).z, 1.0f);
  EXPECT_EQ(normals(0, 0), glm::vec3(0.0f));
  EXPECT_FLOAT_EQ(normalsOf(DepthMap(1, 1, 5.0f), Camera(Pose{}, 1.0, Size{1, 1}))(0, 0).z, 1.0f);
}

}  // namespace
}  // namespace promenade::ibr
