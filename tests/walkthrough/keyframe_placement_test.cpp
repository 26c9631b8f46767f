#include "src/walkthrough/keyframe_placement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "src/walkthrough/walkthrough.h"
#include "tests/walkthrough/analytic_renderer.h"
#include "tests/walkthrough/walks.h"

namespace promenade::walkthrough {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;
using tests::kWalkSize;
using tests::still;
using tests::strafe;

enum class Look { kMatt, kViewDependent };

/// Two endless walls, 6 m before and 6 m behind the origin, each filling the view of a camera that faces it.
class TwoWalls final : public Renderer {
 public:
  explicit TwoWalls(Look look) : look_(look) {}
  [[nodiscard]] Visibility visibility(const Camera& camera) const override {
    ++asked_;
    const bool before = camera.direction({0.5, 0.5}).z < 0.0;
    return {camera, DepthMap(camera.size(), 6.0f),
            NormalMap(camera.size(), glm::vec3(0.0f, 0.0f, before ? 1.0f : -1.0f)),
            ItemBuffer(camera.size(), before ? 1u : 2u)};
  }
  void retrace(Frame&, const Mask&, SampleSource, int) const override {}
  [[nodiscard]] Frame render(const Camera& camera, int) const override {
    return unshaded(visibility(camera));
  }
  [[nodiscard]] ItemTraits traits(ItemId) const override { return {look_ == Look::kViewDependent}; }
  [[nodiscard]] RayCounts rayCounts() const override { return {}; }
  [[nodiscard]] int asked() const { return asked_; }

 private:
  Look look_;
  mutable std::atomic<int> asked_{0};
};

/// How wide the view of `still()` is on a wall, metres: 64:36 with a vertical field of view of 1 radian.
double widthOnWall() {
  return 2.0 * 6.0 * std::tan(0.5) * 64.0 / 36.0;
}

PlacementSettings settingsFor(const paths::CameraPath& path, int longest) {
  return {{0, path.frameCount() - 1}, longest, kWalkSize, {}};
}

Plan placed(const paths::CameraPath& path, const Renderer& renderer, int longest) {
  return placeKeyframes(path, renderer, settingsFor(path, longest), {});
}

/// All of them, by first frame and length - 1; in frames, a whole one being the cost of neighbours.
std::vector<std::vector<double>> allCosts(const paths::CameraPath& path, const Renderer& renderer,
                                          int longest) {
  const SegmentCosts costs = tracingCosts(path, renderer, settingsFor(path, longest));
  std::vector<std::vector<double>> all;
  for (int first = 0; first + 1 < path.frameCount(); ++first) {
    const auto from = costs(first);
    all.emplace_back();
    for (const auto cost : from) {
      all.back().push_back(static_cast<double>(cost) / static_cast<double>(from[0]));
    }
  }
  return all;
}

double costOf(const Plan& plan, const std::vector<std::vector<double>>& costs) {
  return std::accumulate(plan.begin(), plan.end(), 0.0, [&](double sum, const Segment& s) {
    return sum + costs[static_cast<std::size_t>(s.first)][static_cast<std::size_t>(s.last - s.first - 1)];
  });
}

std::vector<int> lengthsOf(const Plan& plan) {
  std::vector<int> lengths;
  for (const Segment& segment : plan) lengths.push_back(segment.last - segment.first);
  return lengths;
}

void turnAround(paths::PathFrame& frame) {
  frame.pose.worldFromCamera = glm::dmat3(glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1));
}

/// A strafe at changing speed past a column, a step back in the middle.
paths::CameraPath unsteady(int frames) {
  auto path = still(frames);
  for (int i = 0; i < frames; ++i) {
    auto& eye = path.frames[static_cast<std::size_t>(i)].pose.eye;
    eye.x = 0.02 * i * i + 0.5 * std::sin(1.7 * i);
    eye.z = 0.4 * std::cos(0.9 * i);
  }
  return path;
}

TEST(KeyframePlacement, CountsWhatNeitherEndOfAStrafeSees) {
  // Each frame is an eighth of the view further. Between keyframes L frames apart lie L / 8 - 1 views that
  // neither sees; the k-th inbetween sees as much of it as it has moved from the nearer of them, at most. A
  // wall whose look depends on the view is traced in each.
  const TwoWalls wall(Look::kViewDependent);
  const auto costs = allCosts(strafe(13, widthOnWall() / 8.0), wall, 12);
  for (int length = 1; length <= 12; ++length) {
    double holes = 0.0;
    for (int k = 1; k < length; ++k) {
      holes += std::clamp(length / 8.0 - 1.0, 0.0, std::min(k, length - k) / 8.0);
    }
    // An edge is off by up to half a column of 80 at either side.
    EXPECT_NEAR(costs[0][static_cast<std::size_t>(length - 1)], 1.0 + holes, (length - 1) / 80.0) << length;
  }
}

TEST(KeyframePlacement, CountsMattSurfaceOnceASegment) {
  // As above, but what the middle traced serves the others.
  const TwoWalls wall(Look::kMatt);
  const auto costs = allCosts(strafe(13, widthOnWall() / 8.0), wall, 12);
  EXPECT_NEAR(costs[0][11], 1.0 + 0.5, 11 / 80.0);
}

TEST(KeyframePlacement, MakesSegmentsAsLongAsBothEndsSeeEverything) {
  // Eight frames are free (above); nine would cost a frame more, as much as a keyframe.
  const TwoWalls wall(Look::kViewDependent);
  EXPECT_THAT(lengthsOf(placed(strafe(25, 0.999 * widthOnWall() / 8.0), wall, 12)), ElementsAre(8, 8, 8));
}

TEST(KeyframePlacement, OfAStillCameraMakesFewSegmentsOfEqualLength) {
  const TwoWalls wall(Look::kMatt);
  EXPECT_THAT(lengthsOf(placed(still(33), wall, 16)), ElementsAre(16, 16));
  EXPECT_THAT(lengthsOf(placed(still(41), wall, 16)), UnorderedElementsAre(13, 13, 14));
  EXPECT_THAT(placed(still(1), wall, 16), ElementsAre(Segment{0, 0, 0}));
  EXPECT_THAT(placed(still(2), wall, 16), ElementsAre(Segment{0, 1, 0}));
}

TEST(KeyframePlacement, PutsKeyframesOnBothSidesOfACut) {
  // A sixteenth of the view a frame. A segment across the cut sees each side from one end alone: 1/16 + ... +
  // 7/16 of a frame missing on either, 3.5 together, for two keyframes less.
  auto path = strafe(16, widthOnWall() / 16.0);
  for (std::size_t i = 8; i < 16; ++i) turnAround(path.frames[i]);
  const TwoWalls walls(Look::kViewDependent);
  EXPECT_THAT(placed(path, walls, 15), ElementsAre(Segment{0, 7, 0}, Segment{7, 8, 0}, Segment{8, 15, 0}));
}

TEST(KeyframePlacement, OfViewsThatShareNothingLeavesNoInbetweens) {
  // Every frame is two views further.
  const TwoWalls wall(Look::kViewDependent);
  const auto costs = allCosts(strafe(6, 2.0 * widthOnWall()), wall, 5);
  // A frame between two others is traced whole whichever of them it is counted with, so that keyframes and
  // inbetweens cost the same.
  EXPECT_DOUBLE_EQ(costs[0][4], 5.0);
  EXPECT_THAT(lengthsOf(placed(strafe(6, 2.0 * widthOnWall()), wall, 5)), ElementsAre(1, 1, 1, 1, 1));
}

TEST(KeyframePlacement, CostsAsMuchForTheWalkInReverse) {
  auto path = unsteady(12);
  const TwoWalls wall(Look::kViewDependent);
  const double there = costOf(placed(path, wall, 7), allCosts(path, wall, 7));
  std::reverse(path.frames.begin(), path.frames.end());
  EXPECT_DOUBLE_EQ(costOf(placed(path, wall, 7), allCosts(path, wall, 7)), there);
}

TEST(KeyframePlacement, IsTheCheapestOfAllDivisions) {
  const auto path = unsteady(11);
  const tests::AnalyticRenderer renderer(tests::Panel::kMirrorLike);
  const auto costs = allCosts(path, renderer, 6);
  double cheapest = std::numeric_limits<double>::infinity();
  for (unsigned keyframes = 0; keyframes < 1u << 9; ++keyframes) {  // which of 1 to 9, between 0 and 10
    Plan plan;
    int first = 0;
    for (int frame = 1; frame <= 10; ++frame) {
      if (frame < 10 && ((keyframes >> (frame - 1)) & 1u) == 0) continue;
      plan.push_back({first, frame, 0});
      first = frame;
    }
    const auto lengths = lengthsOf(plan);
    if (*std::max_element(lengths.begin(), lengths.end()) <= 6) {
      cheapest = std::min(cheapest, costOf(plan, costs));
    }
  }
  EXPECT_DOUBLE_EQ(costOf(placed(path, renderer, 6), costs), cheapest);
}

TEST(KeyframePlacement, CountsWhatTheWalkThenTraces) {
  auto path = still(17);
  for (int i = 0; i < 17; ++i) {  // to the right and back
    path.frames[static_cast<std::size_t>(i)].pose.eye.x = 1.5 * std::sin(std::numbers::pi * i / 16.0);
  }
  const tests::AnalyticRenderer renderer(tests::Panel::kMatt);
  Settings settings = tests::settingsFor(path);
  settings.tolerancePercent = 100.0;  // never split
  settings.probeShare = 0.0;
  settings.keyframeSpacing = 16;
  const Statistics walked = renderParts(path, renderer, settings, equalPartsOf(settings), Outputs{}, nullptr);
  const double holes = 17.0 * walked.tracedFraction() - 2.0;  // in frames, without both keyframes
  ASSERT_GT(holes, 0.1);
  // Edges of holes are counted in samples of another size.
  EXPECT_NEAR(allCosts(path, renderer, 16)[0][15] - 1.0, holes, 0.2 * holes);
}

TEST(KeyframePlacement, LooksAtEveryFrameOnceForAnyNumberOfThreads) {
  const auto path = unsteady(40);
  const TwoWalls walls(Look::kMatt);
  const Plan plan = placed(path, walls, 8);
  EXPECT_EQ(walls.asked(), 40);
  const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(placed(path, walls, 8), plan);
}

TEST(KeyframePlacement, IsThatOfPartsOfTheWalk) {
  const auto path = strafe(30, 0.12);
  const tests::AnalyticRenderer renderer(tests::Panel::kMatt);
  Settings settings = tests::settingsFor(path);
  settings.frames = {3, 28};
  settings.keyframeSpacing = 8;
  EXPECT_EQ(partsOf(path, renderer, settings),
            placeKeyframes(path, renderer, {settings.frames, 8, settings.size, settings.warp}, {}));
  settings.method = Method::kFull;
  EXPECT_EQ(partsOf(path, renderer, settings).size(), 26u);
}

}  // namespace
}  // namespace promenade::walkthrough
