#include "src/core/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace promenade {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2.0;

// With a right-angled view 100 rows high, tan(45 degrees) = 1 = 50 rows: the focal length is 50 pixels.
Camera squareCamera(glm::dvec2 offset = {0.0, 0.0}) {
  return Camera(Pose{}, kRightAngle, Size{200, 100}, offset);
}

// Turned left by a right angle: right is -Z, up is +Y, backward is +X, so it looks along -X.
Pose lookingAlongMinusX() {
  Pose pose;
  pose.worldFromCamera = glm::dmat3(glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0));
  pose.eye = {10.0, 2.0, 3.0};
  return pose;
}

TEST(Camera, FocalLengthInPixelsFollowsFromTheVerticalField) {
  EXPECT_NEAR(squareCamera().focalPixels(), 50.0, 1e-12);
}

TEST(Camera, DefaultIsAConsistentOnePixelCamera) {
  const Camera camera;
  // 0.5 * 1 / tan(0.5 rad) = 0.9152.
  EXPECT_NEAR(camera.focalPixels(), 0.915243861, 1e-8);
  EXPECT_EQ(camera.size(), (Size{1, 1}));
}

TEST(Camera, LooksAlongMinusZThroughTheCentreOfTheImage) {
  const glm::dvec3 d = squareCamera().direction({100.0, 50.0});
  EXPECT_NEAR(d.x, 0.0, 1e-15);
  EXPECT_NEAR(d.y, 0.0, 1e-15);
  EXPECT_EQ(d.z, -1.0);
}

TEST(Camera, ImageXGrowsToTheRightAndImageYDownwards) {
  const glm::dvec3 topLeft = squareCamera().direction({0.0, 0.0});
  // 100 pixels left of the centre over a focal length of 50: x = -2; 50 pixels above: y = +1.
  EXPECT_NEAR(topLeft.x, -2.0, 1e-14);
  EXPECT_NEAR(topLeft.y, 1.0, 1e-14);
}

TEST(Camera, PointAtLiesAtThatDepthAlongTheViewAxis) {
  const Camera camera(lookingAlongMinusX(), kRightAngle, Size{200, 100});
  // 25 pixels right of the centre at depth 4: 4 * 25/50 = 2 to the camera's right (-Z); 4 ahead (-X).
  const glm::dvec3 p = camera.pointAt({125.0, 50.0}, 4.0);
  EXPECT_NEAR(p.x, 6.0, 1e-12);
  EXPECT_NEAR(p.y, 2.0, 1e-12);
  EXPECT_NEAR(p.z, 1.0, 1e-12);
}

TEST(Camera, ProjectsAHandMadePoint) {
  const Camera camera(lookingAlongMinusX(), kRightAngle, Size{200, 100});
  // From the eye (10,2,3) to (0,7,3): 10 ahead, 5 up: 50 * 5/10 = 25 pixels above the centre.
  const auto projection = camera.project({0.0, 7.0, 3.0});
  ASSERT_TRUE(projection.has_value());
  EXPECT_NEAR(projection->pixel.x, 100.0, 1e-12);
  EXPECT_NEAR(projection->pixel.y, 25.0, 1e-12);
  EXPECT_NEAR(projection->depthMetres, 10.0, 1e-12);
}

TEST(Camera, ProjectUndoesPointAtAlsoWithASubpixelOffsetAndOutsideTheImage) {
  const Camera camera(lookingAlongMinusX(), 0.9, Size{37, 21}, {0.3, -0.2});
  for (const glm::dvec2 pixel : {glm::dvec2(0.5, 0.5), glm::dvec2(36.5, 20.5), glm::dvec2(-40.0, 300.0)}) {
    const auto projection = camera.project(camera.pointAt(pixel, 7.5));
    ASSERT_TRUE(projection.has_value());
    EXPECT_NEAR(projection->pixel.x, pixel.x, 1e-10);
    EXPECT_NEAR(projection->pixel.y, pixel.y, 1e-10);
    EXPECT_NEAR(projection->depthMetres, 7.5, 1e-12);
  }
}

TEST(Camera, ProjectsNothingBehindOrInTheEye) {
  EXPECT_FALSE(squareCamera().project({0.0, 0.0, 1.0}).has_value());
  EXPECT_FALSE(squareCamera().project({0.0, 0.0, 0.0}).has_value());
  EXPECT_FALSE(squareCamera().project({1.0, 0.0, 0.0}).has_value());
  EXPECT_FALSE(squareCamera().projectDirection({0.0, 0.0, 1.0}).has_value());
}

TEST(Camera, PointsAtInfinityDoNotDependOnWhereTheEyeIs) {
  Pose near = lookingAlongMinusX();
  Pose far = near;
  far.eye = {1e9, -3e9, 2e9};  // where eye + direction would lose every digit of a small direction
  const glm::dvec3 direction(-0.8, 0.05, 0.1);
  const auto a = Camera(near, 1.0, Size{64, 48}).projectDirection(direction);
  const auto b = Camera(far, 1.0, Size{64, 48}).projectDirection(direction);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->x, b->x);
  EXPECT_EQ(a->y, b->y);
}

TEST(Camera, SubpixelOffsetMovesTheSampleWithinThePixel) {
  // A sample at pixel 99.5 with an offset of +0.5 is the sample at 100 without.
  EXPECT_NEAR(squareCamera({0.5, 0.0}).direction({99.5, 50.0}).x, 0.0, 1e-15);
  EXPECT_NEAR(squareCamera({0.0, 0.5}).direction({100.0, 49.5}).y, 0.0, 1e-15);
}

TEST(Camera, SupersampledSeesTheSameFieldWithSamplesInsideThePixels) {
  const Camera camera(lookingAlongMinusX(), 0.7, Size{9, 5}, {0.25, -0.125});
  const Camera fine = camera.supersampled(3);
  EXPECT_EQ(fine.size(), (Size{27, 15}));
  EXPECT_NEAR(fine.subpixelOffset().x, 0.75, 1e-15);
  // Image position p of the coarse camera is position 3p of the fine one.
  const glm::dvec3 coarseDirection = camera.direction({2.5, 3.5});
  const glm::dvec3 fineDirection = fine.direction({7.5, 10.5});
  EXPECT_NEAR(glm::length(coarseDirection - fineDirection), 0.0, 1e-14);
}

TEST(Camera, OnePixelCameraSeesItsCentre) {
  const Camera camera(Pose{}, 0.5, Size{1, 1});
  EXPECT_EQ(camera.direction({0.5, 0.5}), glm::dvec3(0.0, 0.0, -1.0));
}

}  // namespace
}  // namespace promenade
