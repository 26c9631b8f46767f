#include "paths/rotation.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <numbers>

#include "tests/paths/near.h"

namespace promenade::paths {
namespace {

glm::dquat aboutY(double degrees) {
  return glm::angleAxis(degrees * kDegree, glm::dvec3(0, 1, 0));
}

TEST(LookAt, PutsTheTargetOnTheViewAxisWithUpUp) {
  // From (0,0,5) to the origin is the camera's own rest attitude.
  const Pose rest = lookAt({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, "here");
  expectNear(rest.worldFromCamera[0], {1, 0, 0});
  expectNear(rest.worldFromCamera[1], {0, 1, 0});
  expectNear(rest.worldFromCamera[2], {0, 0, 1});
  // Looking along +x, right is +z.
  const Pose side = lookAt({0, 0, 0}, {2, 0, 0}, {0, 7, 0}, "here");
  expectNear(side.worldFromCamera[0], {0, 0, 1});
  expectNear(side.worldFromCamera[2], {-1, 0, 0});
  expectRotation(side.worldFromCamera);
}

TEST(LookAt, RefusesAnEyeAtTheTargetAndAViewAlongUp) {
  expectRefused(
      [] {
        (void)lookAt({1, 2, 3}, {1, 2, 3}, {0, 1, 0}, "key");
      },
      "key: expected an eye apart from");
  expectRefused(
      [] {
        (void)lookAt({1, 2, 3}, {1, 9, 3}, {0, 1, 0}, "key");
      },
      "key: expected a view that is not along");
  expectRefused([] { (void)lookAt({1, 2, 3}, {1, -9, 3}, {0, 1, 0}, "key"); }, "along 'up'");
}

TEST(RigidPose, IgnoresScaleAndKeepsTheViewDirection) {
  const Pose pose = rigidPose(glm::dmat3({-2, 0, 0}, {0, 3, 0}, {0, 1, 4}), {0, 0, 0}, "node");
  expectRotation(pose.worldFromCamera);
  expectNear(pose.worldFromCamera[2], glm::normalize(glm::dvec3(0, 1, 4)));
  expectRefused([] { (void)rigidPose(glm::dmat3(0.0), {0, 0, 0}, "node"); }, "node: expected camera axes");
}

TEST(UnitQuaternion, RefusesZeroAndNotANumber) {
  expectRefused([] { (void)unitQuaternion({0, 0, 0, 0}, "key"); }, "length above 0");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expectRefused([nan] { (void)unitQuaternion({nan, 0, 0, 1}, "key"); }, "length above 0");
  EXPECT_NEAR(unitQuaternion({0, 0, 5, 0}, "key").y, 1.0, 1e-12);
}

TEST(Slerp, TakesTheShorterWayAtConstantSpeed) {
  EXPECT_NEAR(
      angleBetween(glm::mat3_cast(slerp(aboutY(0), -aboutY(90), 1.0 / 3.0)), glm::mat3_cast(aboutY(30))), 0.0,
      1e-9);
  EXPECT_NEAR(angleBetween(glm::mat3_cast(slerp(aboutY(10), aboutY(10), 0.5)), glm::mat3_cast(aboutY(10))),
              0.0, 1e-9);
}

TEST(AngleBetween, IsExactForTinyAndForHalfTurns) {
  EXPECT_NEAR(angleBetween(glm::dmat3(1.0), glm::mat3_cast(aboutY(1e-7))) / (1e-7 * kDegree), 1.0, 1e-6);
  EXPECT_NEAR(angleBetween(glm::dmat3(1.0), glm::mat3_cast(aboutY(180))), std::numbers::pi, 1e-9);
}

TEST(RotationSpline, TurnsEvenlyThroughEvenKeysAboutOneAxis) {
  // Equal turns in equal times: squad's control points coincide with its keys and it becomes slerp.
  const std::vector<double> times{0, 1, 2, 3};
  const std::vector<glm::dquat> keys{aboutY(0), -aboutY(30), aboutY(60), aboutY(90)};
  const RotationSpline spline(times, keys);
  EXPECT_NEAR(angleBetween(glm::mat3_cast(spline.at(1, 0.25)), glm::mat3_cast(aboutY(37.5))), 0.0, 1e-9);
}

TEST(RotationSpline, HasTheSameAngularVelocityOnBothSidesOfAnUnevenKey) {
  const std::vector<double> times{0, 1, 4, 4.5};
  const std::vector<glm::dquat> keys{aboutY(0), glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 1, 0))),
                                     aboutY(80), glm::angleAxis(1.9, glm::normalize(glm::dvec3(0, 1, 1)))};
  const RotationSpline spline(times, keys);
  const double e = 1e-5;
  for (const std::size_t key : {1u, 2u}) {
    const glm::dquat middle = spline.at(key, 0.0);
    const glm::dquat before = spline.at(key - 1, 1.0 - e);
    const glm::dquat after = spline.at(key, e);
    const glm::dquat in = glm::conjugate(before) * middle;
    const glm::dquat out = glm::conjugate(middle) * after;
    const glm::dvec3 inVelocity = glm::dvec3(in.x, in.y, in.z) / (e * (times[key] - times[key - 1]));
    const glm::dvec3 outVelocity = glm::dvec3(out.x, out.y, out.z) / (e * (times[key + 1] - times[key]));
    expectNear(inVelocity, outVelocity, 1e-3 * glm::length(outVelocity));
    EXPECT_GT(glm::length(outVelocity), 0.01);
  }
}

TEST(RotationSpline, DoesNotSwayWhileItHoldsStill) {
  const std::vector<double> times{0, 1, 2, 3};
  const RotationSpline spline(times, std::vector<glm::dquat>{aboutY(0), aboutY(0), aboutY(90), aboutY(90)});
  EXPECT_NEAR(angleBetween(glm::mat3_cast(spline.at(0, 0.7)), glm::dmat3(1.0)), 0.0, 1e-9);
  // Eases out of the hold: after 1% of the segment far less than 1% of the turn.
  EXPECT_LT(angleBetween(glm::mat3_cast(spline.at(1, 0.01)), glm::dmat3(1.0)), 0.1 * kDegree);
  EXPECT_NEAR(angleBetween(glm::mat3_cast(spline.at(1, 0.5)), glm::mat3_cast(aboutY(45))), 0.0, 1e-9);
}

}  // namespace
}  // namespace promenade::paths
