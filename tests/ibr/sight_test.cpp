#include "ibr/sight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/ibr/analytic_scene.h"

namespace promenade::ibr::tests {
namespace {

constexpr Size kSize{40, 40};
constexpr double kCrease = 30.5;

/// Looks along -z; a point at (x, y, z) is seen at 20 + 20 x / -z.
Camera camera() {
  return cameraAt({0, 0, 0}, kSize, 20.0);
}

/// What the frame says of a point of an item with this normal, seen from the camera's own eye.
Sighting look(const Visibility& seen, const glm::vec3& point, ItemId item, const glm::vec3& normal) {
  const Sight sight(seen, {0, 0, 0}, kCrease);
  const auto projection = seen.camera.project(glm::dvec3(point));
  return sight(glm::vec2(projection->pixel), {item, point, normal, sight.tolerance(-point.z)});
}

const glm::vec3 kTowardsEye(0.0f, 0.0f, 1.0f);

/// A wall at 4 m with a post before it, from x = 0 to x = 2 at 2 m: pixels 20 to 40.
Visibility wallAndPost() {
  AnalyticScene scene;
  scene.add(1, rectangle({-9, -9, -4}, {18, 0, 0}, {0, 18, 0}), uniform(Rgb(1.0f)))
      .add(2, rectangle({0, -9, -2}, {2, 0, 0}, {0, 18, 0}), uniform(Rgb(1.0f)));
  return scene.visibility(camera());
}

TEST(Sight, SeesASurfaceThroughAllSamplesAround) {
  const Sighting found = look(wallAndPost(), {-1.0f, 0.1f, -4.0f}, 1, kTowardsEye);
  EXPECT_TRUE(found.isInside);
  EXPECT_EQ(found.hiding, 0);
  EXPECT_EQ(found.agreeing, 0b1111);
}

TEST(Sight, DoesNotSeeWhatIsHidden) {
  const Sighting found = look(wallAndPost(), {1.0f, 0.1f, -4.0f}, 1, kTowardsEye);
  EXPECT_EQ(found.agreeing, 0);
  EXPECT_EQ(found.hiding, 0b1111);
}

TEST(Sight, CannotTellBesideAnEdge) {
  // Pixel 20: the samples at 19.5 show the wall, those at 20.5 the post.
  const Sighting found = look(wallAndPost(), {-0.001f, 0.1f, -4.0f}, 1, kTowardsEye);
  EXPECT_EQ(found.agreeing, 0b0101);
  EXPECT_EQ(found.hiding, 0b1010);
  // Of the nearer surface there is no doubt.
  EXPECT_EQ(look(wallAndPost(), {0.001f, 0.1f, -2.0f}, 2, kTowardsEye).hiding, 0);
}

TEST(Sight, SeesWhatIsThinnerThanItsSamplesAreApart) {
  // A wire in front of everything, between samples.
  const Sighting found = look(wallAndPost(), {-0.5f, 0.1f, -3.0f}, 3, kTowardsEye);
  EXPECT_EQ(found.hiding, 0);
  EXPECT_EQ(found.agreeing, 0);
}

TEST(Sight, SeesTheBackgroundOnlyWhereNothingIsBeforeIt) {
  AnalyticScene scene;
  scene.add(1, rectangle({0, -9, -4}, {9, 0, 0}, {0, 18, 0}), uniform(Rgb(1.0f)));
  const Visibility seen = scene.visibility(camera());
  const Sight sight(seen, {0, 0, 0}, kCrease);
  EXPECT_EQ(sight({5.0f, 5.0f}, {}).hiding, 0);
  EXPECT_EQ(sight({20.0f, 5.0f}, {}).agreeing, 0b0101);
  EXPECT_EQ(sight({20.0f, 5.0f}, {}).hiding, 0b1010);
  EXPECT_EQ(sight({30.0f, 5.0f}, {}).hiding, 0b1111);
}

TEST(Sight, KnowsThatFacesThatMeetInAnEdgeDoNotHideEachOther) {
  // A corner of a room, x = 1 and z = -4; then the corner of a pillar, its edge towards the eye.
  AnalyticScene room;
  room.add(1, rectangle({-9, -9, -4}, {10, 0, 0}, {0, 18, 0}), uniform(Rgb(1.0f)))
      .add(2, rectangle({1, -9, -4}, {0, 0, 9}, {0, 18, 0}), uniform(Rgb(1.0f)));
  EXPECT_EQ(look(room.visibility(camera()), {0.999f, 0.1f, -4.0f}, 1, kTowardsEye).hiding, 0);
  const float diagonal = std::sqrt(0.5f);
  AnalyticScene pillar;
  pillar.add(1, rectangle({0, -9, -3}, {-2, 0, -2}, {0, 18, 0}), uniform(Rgb(1.0f)))
      .add(2, rectangle({0, -9, -3}, {2, 0, -2}, {0, 18, 0}), uniform(Rgb(1.0f)));
  const Sighting left =
      look(pillar.visibility(camera()), {-0.01f, 0.1f, -3.01f}, 1, {-diagonal, 0.0f, diagonal});
  EXPECT_EQ(left.hiding, 0);
  EXPECT_EQ(left.agreeing, 0b0101);
}

TEST(Sight, KnowsNothingOutsideOfTheImage) {
  const Visibility seen = wallAndPost();
  const Sight sight(seen, {0, 0, 0}, kCrease);
  EXPECT_FALSE(sight({-0.6f, 5.0f}, {}).isInside);
  EXPECT_FALSE(sight({5.0f, 40.6f}, {}).isInside);
  EXPECT_FALSE(sight({std::numeric_limits<float>::quiet_NaN(), 5.0f}, {}).isInside);
}

}  // namespace
}  // namespace promenade::ibr::tests
