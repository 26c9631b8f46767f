#include <cmath>
#include <limits>

#include "paths/from_animation.h"
#include "tests/paths/near.h"

namespace promenade::paths {
namespace {

const float kHalf = std::sqrt(0.5f);

CameraAnimation moving(Track<glm::vec3> track) {
  CameraAnimation animation;
  animation.name = "walk";
  animation.rootToCamera.emplace_back();
  animation.rootToCamera[0].name = "cam";
  animation.rootToCamera[0].translationTrack = std::move(track);
  return animation;
}

CameraPath read(const CameraAnimation& animation, double fps) {
  return pathFromAnimation(animation, fps, "scene");
}

TEST(Animation, LinearTranslationIsInterpolatedAndStartsAtTheFirstKey) {
  const CameraPath path =
      read(moving({Interpolation::kLinear, {2.0f, 3.0f, 5.0f}, {{0, 0, 0}, {4, 0, 0}, {4, 8, 0}}}), 2.0);
  ASSERT_EQ(path.frameCount(), 6);  // 3 s
  expectNear(path.frames[1].pose.eye, {2, 0, 0});
  expectNear(path.frames[4].pose.eye, {4, 4, 0});
  expectNear(path.frames[5].pose.eye, {4, 6, 0});
}

TEST(Animation, StepHoldsEachValueUntilTheNextKey) {
  const CameraPath path =
      read(moving({Interpolation::kStep, {0.0f, 1.0f, 2.0f}, {{0, 0, 0}, {4, 0, 0}, {5, 0, 0}}}), 4.0);
  ASSERT_EQ(path.frameCount(), 8);
  expectNear(path.frames[3].pose.eye, {0, 0, 0});
  expectNear(path.frames[4].pose.eye, {4, 0, 0});
  expectNear(path.frames[7].pose.eye, {4, 0, 0});
}

TEST(Animation, CubicSplineIsTheHermiteOfAppendixC) {
  // Keys at 0 s and 2 s: values 0 and 1, out-tangent 3 /s, in-tangent -1 /s. At u = 1/2 (t_d = 2):
  // 1/2 * 0 + 2 * 1/8 * 3 + 1/2 * 1 + 2 * (-1/8) * (-1) = 0.75 + 0.5 + 0.25 = 1.5.
  // At u = 1/4: h00 = 27/32, h10 = 9/64, h01 = 5/32, h11 = -3/64: 2*9/64*3 + 5/32 + 2*3/64 = 54/64 + 10/64 +
  // 6/64 = 70/64.
  const CameraPath path = read(moving({Interpolation::kCubicSpline,
                                       {0.0f, 2.0f},
                                       {{9, 9, 9}, {0, 0, 0}, {3, 0, 0}, {-1, 0, 0}, {1, 0, 0}, {9, 9, 9}}}),
                               2.0);
  ASSERT_EQ(path.frameCount(), 4);
  expectNear(path.frames[1].pose.eye, {70.0 / 64.0, 0, 0});
  expectNear(path.frames[2].pose.eye, {1.5, 0, 0});
}

TEST(Animation, RotationsAreSlerpedTheShorterWay) {
  // From the identity to 90 degrees about +y given with the opposite sign; half-way backward is (sin 45, 0,
  // cos 45).
  CameraAnimation animation;
  animation.rootToCamera.emplace_back();
  animation.rootToCamera[0].rotationTrack =
      Track<glm::vec4>{Interpolation::kLinear, {0.0f, 1.0f}, {{0, 0, 0, 1}, {0, -kHalf, 0, -kHalf}}};
  const CameraPath path = read(animation, 2.0);
  ASSERT_EQ(path.frameCount(), 2);
  const double s = std::sqrt(0.5);
  expectNear(path.frames[1].pose.worldFromCamera[2], {s, 0, s}, 1e-6);
}

TEST(Animation, CubicSplineRotationsAreNormalised) {
  // Zero tangents: half-way between (0,0,0,1) and (0,h,0,h) is their mean, normalised: 45 degrees.
  CameraAnimation animation;
  animation.rootToCamera.emplace_back();
  animation.rootToCamera[0].rotationTrack = Track<glm::vec4>{
      Interpolation::kCubicSpline,
      {0.0f, 1.0f},
      {{0, 0, 0, 0}, {0, 0, 0, 1}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, kHalf, 0, kHalf}, {0, 0, 0, 0}}};
  const CameraPath path = read(animation, 2.0);
  const double s = std::sqrt(0.5);
  expectNear(path.frames[1].pose.worldFromCamera[2], {s, 0, s}, 1e-6);
  expectRotation(path.frames[1].pose.worldFromCamera);
}

TEST(Animation, ParentsMoveTurnAndScaleTheCamerasPlaceOnly) {
  // Parent: at (10,0,0), turned 90 degrees about +y (x -> -z, z -> x), scaled by 2. The camera at (1,0,0) in
  // it: (10,0,0) + 2 * (0,0,-1); its backward axis z becomes x.
  CameraAnimation animation = moving({Interpolation::kLinear, {0.0f, 1.0f}, {{1, 0, 0}, {3, 0, 0}}});
  AnimatedNode parent;
  parent.restMatrix = glm::dmat4({0, 0, -2, 0}, {0, 2, 0, 0}, {2, 0, 0, 0}, {10, 0, 0, 1});
  animation.rootToCamera.insert(animation.rootToCamera.begin(), parent);
  animation.rootToCamera[1].scale = {-5, 7, 0.5};
  const CameraPath path = read(animation, 2.0);
  expectNear(path.frames[0].pose.eye, {10, 0, -2});
  expectNear(path.frames[1].pose.eye, {10, 0, -4});
  expectNear(path.frames[1].pose.worldFromCamera[2], {1, 0, 0});
  expectRotation(path.frames[1].pose.worldFromCamera);
}

TEST(Animation, ACameraAtRestIsOneFrame) {
  CameraAnimation rest;
  rest.rootToCamera.emplace_back();
  rest.rootToCamera[0].restMatrix[3] = {1, 2, 3, 1};
  rest.verticalFieldOfView = 0.7;
  const CameraPath path = pathFromAnimation(rest, std::nullopt, "scene");
  ASSERT_EQ(path.frameCount(), 1);
  EXPECT_EQ(path.framesPerSecond, 25.0);
  EXPECT_EQ(path.frames[0].verticalFieldOfView, 0.7);
  expectNear(path.frames[0].pose.eye, {1, 2, 3});
}

TEST(Animation, NamesEveryDegenerateInput) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto refused = [](const CameraAnimation& animation, const std::string& part) {
    SCOPED_TRACE(part);
    expectRefused([&] { (void)read(animation, 25.0); }, part);
  };
  const auto linear = Interpolation::kLinear;
  refused(moving({linear, {1.0f}, {{0, 0, 0}}}),
          "scene: animation 'walk': expected keys at two or more times, found all at 1 s");
  refused(moving({linear, {}, {}}), "node 'cam': translation: expected 1 value(s)");
  refused(moving({linear, {0.0f, 0.0f}, {{0, 0, 0}, {1, 0, 0}}}), "strictly increasing times");
  refused(moving({linear, {0.0f, nan}, {{0, 0, 0}, {1, 0, 0}}}), "expected finite times");
  refused(moving({linear, {0.0f, 1.0f}, {{0, 0, 0}, {nan, 0, 0}}}), "expected finite values");
  refused(moving({Interpolation::kCubicSpline, {0.0f, 1.0f}, {{0, 0, 0}, {1, 0, 0}}}), "expected 3 value(s)");
  refused(moving({linear, {0.0f, 1e9f}, {{0, 0, 0}, {1, 0, 0}}}), "expected at most 1000000 frames");
  CameraAnimation turning;
  turning.rootToCamera.emplace_back();
  turning.rootToCamera[0].rotationTrack =
      Track<glm::vec4>{linear, {0.0f, 1.0f}, {{0, 0, 0, 1}, {0, 0, 0, 0}}};
  refused(turning, "expected a rotation quaternion");
  CameraAnimation flat = moving({linear, {0.0f, 1.0f}, {{0, 0, 0}, {1, 0, 0}}});
  flat.rootToCamera[0].scale = {1, 1, 0};
  refused(flat, "expected camera axes");
}

}  // namespace
}  // namespace promenade::paths
