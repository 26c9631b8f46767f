#include "ibr/coverage.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/ibr/analytic_scene.h"

namespace promenade::ibr::tests {
namespace {

constexpr Size kView{40, 40};
constexpr double kTurn = 18.0;
constexpr ItemId kWall = 1;
constexpr ItemId kPost = 2;

/// A wall at 4 m and a post before it at 2 m, from `left` to `left` + 0.5 m. With 20 pixels of focal length a
/// metre there is 10 pixels, and x = 0 is pixel 20.
AnalyticScene postBeforeAWall(double left) {
  AnalyticScene scene;
  scene.add(kWall, rectangle({-9, -9, -4}, {18, 0, 0}, {0, 18, 0}), uniform(Rgb(1.0f)))
      .add(kPost, rectangle({left, -9, -2}, {0.5, 0, 0}, {0, 18, 0}), uniform(Rgb(1.0f)));
  return scene;
}

Camera besideThePost(double x, glm::dvec2 offset) {
  return cameraAt({x, 0, 0}, kView, 20.0).withSubpixelOffset(offset);
}

/// Where the post's left edge (pixel 20.23) is taken to be: from there on the surface of the sample at 20.5
/// reaches. Found in steps of 0.01 pixels; the sample at 19.5 shows the wall.
double edgeFoundBy(const Visibility& frame, const std::vector<const Visibility*>& others) {
  const Coverage coverage(frame, others, kTurn);
  double edge = 20.5;
  while (edge > 19.0 && coverage.reaches(20, 20, glm::vec2(edge - 0.01, 20.5))) edge -= 0.01;
  return edge;
}

TEST(Coverage, OfASurfaceGoesHalfWayToASampleThatDoesNotShowIt) {
  const AnalyticScene scene = postBeforeAWall(0.023);
  const Visibility frame = scene.visibility(besideThePost(0.0, {0, 0}));
  ASSERT_EQ(frame.item(19, 20), kWall);
  ASSERT_EQ(frame.item(20, 20), kPost);
  EXPECT_NEAR(edgeFoundBy(frame, {}), 20.0, 0.02);
}

TEST(Coverage, IsKnownAsFinelyAsTheSamplesOfAllFramesTogether) {
  const AnalyticScene scene = postBeforeAWall(0.023);
  const Visibility frame = scene.visibility(besideThePost(0.0, {0, 0}));
  // Two frames before and two after have samples a fifth of a pixel further on the post each: at rest by
  // their offsets, or because the post moves by 0.12 m x 10 pixels = 1.2 pixels a frame. Each by itself would
  // have the edge half way between two samples: at 19.8, 20.0, 20.2, 20.4, and 20.6; most have it from 20.2
  // on.
  const auto edgeAmong = [&](double stepMetres, double offset) {
    std::vector<Visibility> others;
    for (const int i : {-2, -1, 1, 2}) {
      others.push_back(scene.visibility(besideThePost(stepMetres * i, {offset * i, 0.0})));
    }
    std::vector<const Visibility*> asked;
    for (const Visibility& other : others) asked.push_back(&other);
    return edgeFoundBy(frame, asked);
  };
  EXPECT_NEAR(edgeAmong(0.0, 0.2), 20.2, 0.02);
  EXPECT_NEAR(edgeAmong(0.12, 0.0), 20.2, 0.02);
}

TEST(Coverage, IsNotToldByWhatIsInFront) {
  // In the other frame a nearer plate hides both edge and wall: it is as if nobody had been asked.
  const AnalyticScene scene = postBeforeAWall(0.023);
  const Visibility frame = scene.visibility(besideThePost(0.0, {0, 0}));
  AnalyticScene hidden = postBeforeAWall(0.023);
  hidden.add(3, rectangle({-9, -9, -1}, {18, 0, 0}, {0, 18, 0}), uniform(Rgb(1.0f)));
  const Visibility other = hidden.visibility(besideThePost(0.0, {0.25, 0}));
  EXPECT_NEAR(edgeFoundBy(frame, {&other}), edgeFoundBy(frame, {}), 1e-9);
}

TEST(Coverage, LeavesNoGapBetweenFacesOfTheSameThing) {
  // A column of 12 faces, 0.3 m thick, 2 m away: each is about 0.8 pixels wide in the middle and turned by 30
  // degrees against the next. At all places between two of its samples one of both surfaces is there.
  AnalyticScene scene;
  scene.add(kWall, rectangle({-9, -9, -4}, {18, 0, 0}, {0, 18, 0}), uniform(Rgb(1.0f)))
      .add(kPost, prism({0, -9, -2}, 0.15, 18.0, 12), uniform(Rgb(1.0f)));
  const Visibility frame = scene.visibility(besideThePost(0.0, {0, 0}));
  const Visibility other = scene.visibility(besideThePost(0.0, {0.3, 0}));
  const std::vector<const Visibility*> asked{&other};
  const Coverage coverage(frame, asked, kTurn);
  ASSERT_EQ(frame.item(19, 20), kPost);
  ASSERT_EQ(frame.item(20, 20), kPost);
  for (float place = 19.5f; place < 20.5f; place += 0.05f) {
    EXPECT_TRUE(coverage.reaches(19, 20, {place, 20.5f}) || coverage.reaches(20, 20, {place, 20.5f}))
        << place;
  }
}

TEST(Coverage, GoesOnWhereNobodyLooks) {
  // Beyond the image.
  const AnalyticScene scene = postBeforeAWall(0.023);
  const Visibility frame = scene.visibility(besideThePost(0.0, {0, 0}));
  EXPECT_TRUE(Coverage(frame, {}, kTurn).reaches(20, 0, {20.5f, -0.3f}));
}

}  // namespace
}  // namespace promenade::ibr::tests
