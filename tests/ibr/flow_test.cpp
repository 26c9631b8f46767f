#include "ibr/flow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "src/core/errors.h"
#include "tests/ibr/analytic_scene.h"
#include "tests/ibr/maps.h"

namespace promenade::ibr::tests {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

Visibility atDepth(const Camera& camera, float depth) {
  const Size size = camera.size();
  const bool background = depth == kInfinitelyFar;
  return {camera, DepthMap(size, depth), NormalMap(size, background ? glm::vec3(0.0f) : glm::vec3(0, 0, 1)),
          ItemBuffer(size, background ? kNoItem : 1U)};
}

PixelFlow constantFlow(Size size, glm::vec2 flow) {
  return PixelFlow(size, flow);
}

TEST(PixelFlow, IsExactlyZeroForAStillCamera) {
  for (const Size size : {Size{1, 1}, Size{7, 5}, Size{64, 48}}) {
    const Camera camera =
        turnedCamera({31.7, -2.2, 901.3}, 0.7, -0.3, 0.1, size, 53.3).withSubpixelOffset({0.3, -0.2});
    for (const float depth : {0.01f, 3.7f, 1e6f, kInfinitelyFar}) {
      const PixelFlow flow = pixelFlow(atDepth(camera, depth), camera);
      for (const glm::vec2 f : flow.pixels()) EXPECT_EQ(f, glm::vec2(0.0f));
    }
  }
}

TEST(PixelFlow, OfATranslationParallelToAWallIsFocalLengthTimesTranslationOverDepthEverywhere) {
  const Size size{33, 21};
  const double focal = 40.0;
  // The camera moves 0.25 m right and 0.1 m up before a wall 2 m away: the wall moves 40 * 0.25 / 2 = 5
  // pixels left and 40 * 0.1 / 2 = 2 pixels down.
  const PixelFlow flow =
      pixelFlow(atDepth(cameraAt({0, 0, 0}, size, focal), 2.0f), cameraAt({0.25, 0.1, 0}, size, focal));
  for (const glm::vec2 f : flow.pixels()) {
    EXPECT_FLOAT_EQ(f.x, -5.0f);
    EXPECT_FLOAT_EQ(f.y, 2.0f);
  }
}

TEST(PixelFlow, OfAMoveTowardAWallPointsAwayFromTheCentre) {
  const Size size{31, 31};
  // From 4 m to 3 m: image positions relative to the centre grow by 4/3, so the flow is a third of the
  // position.
  const PixelFlow flow =
      pixelFlow(atDepth(cameraAt({0, 0, 0}, size, 25.0), 4.0f), cameraAt({0, 0, -1.0}, size, 25.0));
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      EXPECT_NEAR(flow(x, y).x, static_cast<float>(x - 15) / 3.0f, 1e-5f);
      EXPECT_NEAR(flow(x, y).y, static_cast<float>(y - 15) / 3.0f, 1e-5f);
    }
  }
}

TEST(PixelFlow, OfAPureRotationDoesNotDependOnDepth) {
  const Size size{29, 17};
  const glm::dvec3 eye(3.0, 1.0, -2.0);
  const Camera from = turnedCamera(eye, 0.2, 0.1, 0.0, size, 30.0);
  const Camera to = turnedCamera(eye, 0.35, -0.05, 0.2, size, 30.0);
  const PixelFlow infinitelyFar = pixelFlow(atDepth(from, kInfinitelyFar), to);
  for (const float depth : {0.1f, 1.0f, 77.0f}) {
    const PixelFlow flow = pixelFlow(atDepth(from, depth), to);
    for (std::size_t i = 0; i < flow.pixels().size(); ++i)
      EXPECT_EQ(flow.pixels()[i], infinitelyFar.pixels()[i]);
  }
}

TEST(PixelFlow, OfARollGrowsWithTheRadius) {
  const Size size{41, 41};
  const double angle = 0.1;
  const PixelFlow flow = pixelFlow(atDepth(cameraAt({0, 0, 0}, size, 35.0), 5.0f),
                                   turnedCamera({0, 0, 0}, 0, 0, angle, size, 35.0));
  // A chord of the circle of that radius: 2 r sin(angle / 2), perpendicular to the mean of both positions.
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const glm::vec2 position(static_cast<float>(x - 20), static_cast<float>(y - 20));
      const glm::vec2 f = flow(x, y);
      EXPECT_NEAR(glm::length(f), 2.0 * glm::length(position) * std::sin(0.5 * angle), 1e-5);
      EXPECT_NEAR(glm::dot(f, position + 0.5f * f), 0.0f, 1e-3f);
    }
  }
  // The camera's up axis turns to its left (counterclockwise), the image clockwise: the top moves right.
  EXPECT_GT(flow(20, 0).x, 0.0f);
}

TEST(PixelFlow, OfTheBackgroundIsThatOfAPointAtInfinity) {
  const Size size{15, 11};
  const Camera from = cameraAt({0, 0, 0}, size, 20.0);
  const PixelFlow moved = pixelFlow(atDepth(from, kInfinitelyFar), cameraAt({5.0, -3.0, 2.0}, size, 20.0));
  for (const glm::vec2 f : moved.pixels()) EXPECT_EQ(f, glm::vec2(0.0f));

  const Camera to = turnedCamera({5.0, -3.0, 2.0}, 0.3, 0.2, 0.1, size, 20.0);
  const PixelFlow turned = pixelFlow(atDepth(from, kInfinitelyFar), to);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const glm::dvec2 pixel(x + 0.5, y + 0.5);
      const auto expected = to.projectDirection(from.direction(pixel));
      ASSERT_TRUE(expected);
      EXPECT_NEAR(turned(x, y).x, expected->x - pixel.x, 1e-4);
      EXPECT_NEAR(turned(x, y).y, expected->y - pixel.y, 1e-4);
    }
  }
}

TEST(PixelFlow, AgreesWithProjectionForAnyTwoCameras) {
  const Size size{37, 23};
  const Camera from = turnedCamera({1, 2, 3}, 0.4, 0.2, -0.1, size, 31.0).withSubpixelOffset({0.25, -0.4});
  const Camera to = turnedCamera({1.4, 1.9, 2.2}, 0.1, 0.3, 0.3, size, 45.0).withSubpixelOffset({-0.1, 0.5});
  Visibility visibility = atDepth(from, 1.0f);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x)
      visibility.depth(x, y) = 2.0f + 0.3f * static_cast<float>((3 * x + 5 * y) % 17);
  }
  const PixelFlow flow = pixelFlow(visibility, to);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const glm::dvec2 pixel(x + 0.5, y + 0.5);
      const auto expected = to.project(from.pointAt(pixel, visibility.depth(x, y)));
      ASSERT_TRUE(expected);
      EXPECT_NEAR(flow(x, y).x, expected->pixel.x - pixel.x, 1e-4);
      EXPECT_NEAR(flow(x, y).y, expected->pixel.y - pixel.y, 1e-4);
    }
  }
}

TEST(PixelFlow, IsNotANumberBehindTheEyeAndSaysNothingElse) {
  const Size size{9, 9};
  const Camera from = cameraAt({0, 0, 0}, size, 10.0);
  // 3 m ahead of the wall at 2 m: the wall is behind the eye. Background is not, however far the camera goes.
  const PixelFlow passed = pixelFlow(atDepth(from, 2.0f), cameraAt({0, 0, -3.0}, size, 10.0));
  for (const glm::vec2 f : passed.pixels()) EXPECT_TRUE(std::isnan(f.x) && std::isnan(f.y));
  // In the plane of the eye there is no image either.
  const PixelFlow beside = pixelFlow(atDepth(from, 2.0f), cameraAt({0, 0, -2.0}, size, 10.0));
  for (const glm::vec2 f : beside.pixels()) EXPECT_TRUE(std::isnan(f.x) && std::isnan(f.y));
  const PixelFlow turnedRound =
      pixelFlow(atDepth(from, kInfinitelyFar), turnedCamera({0, 0, 0}, 3.14159265358979, 0, 0, size, 10.0));
  for (const glm::vec2 f : turnedRound.pixels()) EXPECT_TRUE(std::isnan(f.x));
}

TEST(PixelFlow, GoesOnOutsideTheImage) {
  const Size size{9, 9};
  // 100 m to the right at a depth of 1 m, 10 pixels of focal length: 1000 pixels to the left.
  const PixelFlow flow =
      pixelFlow(atDepth(cameraAt({0, 0, 0}, size, 10.0), 1.0f), cameraAt({100.0, 0, 0}, size, 10.0));
  for (const glm::vec2 f : flow.pixels()) EXPECT_FLOAT_EQ(f.x, -1000.0f);
}

TEST(PixelFlow, OfASubpixelOffsetIsItsOpposite) {
  const Camera camera = cameraAt({0, 0, 0}, {5, 3}, 10.0);
  const PixelFlow flow = pixelFlow(atDepth(camera, 4.0f), camera.withSubpixelOffset({0.25, -0.5}));
  for (const glm::vec2 f : flow.pixels()) EXPECT_EQ(f, glm::vec2(-0.25f, 0.5f));
}

TEST(PixelFlow, RejectsMapsThatDoNotFit) {
  const Camera camera = cameraAt({0, 0, 0}, {5, 3}, 10.0);
  EXPECT_THROW((void)pixelFlow(atDepth(camera, 1.0f), cameraAt({0, 0, 0}, {5, 4}, 10.0)), InputError);
  Visibility broken = atDepth(camera, 1.0f);
  broken.depth = DepthMap(Size{4, 3});
  EXPECT_THROW((void)pixelFlow(broken, camera), InputError);
}

TEST(ImageVelocity, IsTheMeanSpeedTimesFrameRateOverPixelsPerDegree) {
  const Size size{3, 1};
  // 4 pixels since the previous frame, 2 to the next one: 3 pixels a frame on average, 25 frames a second and
  // 50 pixels a degree: 1.5 degrees a second, to the right.
  const VelocityMap v = imageVelocity(constantFlow(size, {-4, 0}), constantFlow(size, {2, 0}), 25.0, 50.0);
  for (const glm::vec2 value : v.pixels()) {
    EXPECT_FLOAT_EQ(value.x, 1.5f);
    EXPECT_EQ(value.y, 0.0f);
  }
}

TEST(ImageVelocity, HasTheDirectionOfTheMeanVectorAndTheMeanOfTheMagnitudes) {
  // Since the previous frame 3 right, to the next one 3 down: mean vector along (1, 1), speed 3.
  const VelocityMap v = imageVelocity(constantFlow({1, 1}, {-3, 0}), constantFlow({1, 1}, {0, 3}), 1.0, 1.0);
  EXPECT_NEAR(v(0, 0).x, 3.0 / std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(v(0, 0).y, 3.0 / std::sqrt(2.0), 1e-6);
}

TEST(ImageVelocity, OfAPointThatTurnsBackKeepsItsSpeed) {
  const VelocityMap v = imageVelocity(constantFlow({1, 1}, {2, 0}), constantFlow({1, 1}, {2, 0}), 1.0, 1.0);
  EXPECT_FLOAT_EQ(v(0, 0).x, 2.0f);
  EXPECT_EQ(v(0, 0).y, 0.0f);
}

TEST(ImageVelocity, UsesTheOtherFlowWhereOneIsMissing) {
  const Size size{2, 2};
  const PixelFlow invalid = constantFlow(size, glm::vec2(kNaN));
  const PixelFlow next = constantFlow(size, {1, -2});
  EXPECT_EQ(imageVelocity(invalid, next, 10.0, 5.0)(1, 1), glm::vec2(2, -4));
  EXPECT_EQ(imageVelocity(next, invalid, 10.0, 5.0)(1, 1), glm::vec2(-2, 4));
  EXPECT_EQ(imageVelocity({}, next, 10.0, 5.0)(1, 1), glm::vec2(2, -4));
  EXPECT_EQ(imageVelocity(next, {}, 10.0, 5.0)(1, 1), glm::vec2(-2, 4));
  EXPECT_EQ(imageVelocity(invalid, invalid, 10.0, 5.0)(1, 1), glm::vec2(0, 0));
  EXPECT_TRUE(imageVelocity({}, {}, 10.0, 5.0).empty());
}

TEST(ImageVelocity, IsFiniteForTheLargestFlows) {
  const float most = std::numeric_limits<float>::max();
  const VelocityMap v =
      imageVelocity(constantFlow({1, 1}, {-most, most}), constantFlow({1, 1}, {most, most}), 100.0, 0.1);
  EXPECT_TRUE(std::isfinite(v(0, 0).x) && std::isfinite(v(0, 0).y));
}

TEST(ImageVelocity, RejectsWhatMakesNoSense) {
  const PixelFlow flow = constantFlow({2, 2}, {1, 1});
  EXPECT_THROW((void)imageVelocity(flow, constantFlow({2, 3}, {1, 1}), 25.0, 40.0), InputError);
  EXPECT_THROW((void)imageVelocity(flow, flow, 0.0, 40.0), InputError);
  EXPECT_THROW((void)imageVelocity(flow, flow, 25.0, -1.0), InputError);
  EXPECT_THROW((void)imageVelocity(flow, flow, 25.0, std::nan("")), InputError);
}

}  // namespace
}  // namespace promenade::ibr::tests
