#include "src/walkthrough/verify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/walkthrough/analytic_renderer.h"
#include "tests/walkthrough/walks.h"

namespace promenade::walkthrough {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using tests::AnalyticRenderer;
using tests::kPanel;
using tests::kWall;
using tests::Panel;

constexpr int kFrames = 9;

/// Half a metre to the right and back: the first and the last frame are the same, so that any two warps of
/// them agree, and what slides over a surface in between is in neither.
paths::CameraPath thereAndBack() {
  paths::CameraPath path;
  for (int i = 0; i < kFrames; ++i) {
    Pose pose;
    // Turned a little to the right, where the panel is.
    pose.eye.x = 1.0 + 0.5 * std::sin(std::numbers::pi * i / (kFrames - 1));
    path.frames.push_back({pose, 0.5});
  }
  return path;
}

/// Judged once, in the middle.
Settings inOneSegment(const paths::CameraPath& path) {
  Settings settings = tests::settingsFor(path, {128, 72});
  settings.keyframeSpacing = kFrames - 1;
  return settings;
}

Statistics walk(const AnalyticRenderer& renderer, double probeShare) {
  const auto path = thereAndBack();
  Settings settings = inOneSegment(path);
  settings.probeShare = probeShare;
  return renderWalkthrough(path, renderer, settings, {});
}

TEST(VerifyMiddle, SplitsWhereTwoWarpsAgreeAndBothAreWrong) {
  const AnalyticRenderer renderer(Panel::kSheen);
  // The control: without probes nothing is amiss.
  const Statistics trusting = walk(renderer, 0.0);
  ASSERT_EQ(trusting.segments.size(), 1u);
  EXPECT_EQ(trusting.segments[0].differencePercent, 0.0);
  EXPECT_EQ(trusting.segments[0].decision, Decision::kAccept);
  EXPECT_EQ(trusting.segments[0].probes, 0u);

  const Statistics verified = walk(renderer, 0.01);
  EXPECT_EQ(verified.segments[0].differencePercent, 0.0);
  EXPECT_GT(verified.segments[0].probeDifferencePercent, 3.0);
  EXPECT_EQ(verified.segments[0].decision, Decision::kSplit);
}

TEST(VerifyMiddle, TracesAViewDependentItemThatWasProvenByTwoWrongWarps) {
  const AnalyticRenderer renderer(Panel::kMirrorLike);
  const Statistics trusting = walk(renderer, 0.0);
  EXPECT_THAT(trusting.frames[4].itemsTraced, IsEmpty());
  const Statistics verified = walk(renderer, 0.01);
  EXPECT_EQ(verified.segments[0].decision, Decision::kAccept);
  EXPECT_THAT(verified.frames[4].itemsTraced, ElementsAre(kPanel));
}

TEST(VerifyMiddle, AcceptsARightWarpAndCountsItsProbes) {
  const AnalyticRenderer renderer(Panel::kMatt);
  const Statistics verified = walk(renderer, 0.01);
  ASSERT_EQ(verified.segments.size(), 1u);
  EXPECT_EQ(verified.segments[0].decision, Decision::kAccept);
  EXPECT_LT(verified.segments[0].probeDifferencePercent, 0.5);
  // 1% of what is warped, to within the rounding of tiles.
  EXPECT_NEAR(static_cast<double>(verified.segments[0].probes),
              0.01 * static_cast<double>(verified.frames[4].warped), 40.0);
  EXPECT_EQ(verified.samplesTraced(), renderer.shaded());
}

TEST(VerifyMiddle, IsNotMisledByNoise) {
  // Noise of 30% a sample is seen by anybody: a comparison of single samples would find nothing but errors.
  const AnalyticRenderer renderer(Panel::kMatt, 0.3);
  const auto path = thereAndBack();
  const Settings settings = inOneSegment(path);
  const Frame first = renderer.render(path.camera(0, settings.size).supersampled(2), 0);
  const Frame last = renderer.render(path.camera(8, settings.size).supersampled(2), 8);
  WarpedPair warped;
  warped.target = renderer.visibility(path.camera(4, settings.size).supersampled(2));
  warped.fromFirst = ibr::gatherWarp(first, warped.target, {});
  warped.fromLast = ibr::gatherWarp(last, warped.target, {});
  warped.disputed = disputedSamples(warped);
  PartSeconds seconds;
  const Verification verification =
      verifyMiddle({4, 0.5, warped, VelocityMap(), {}}, renderer, settings, seconds);
  EXPECT_GT(verification.probes, 200u);
  EXPECT_EQ(verification.decision, Decision::kAccept);
  EXPECT_LT(verification.differencePercent, 1.0);
}

class ProbeWeightsOfAWall : public testing::Test {
 protected:
  ProbeWeightsOfAWall() {
    const Size size{3, 1};
    pair.target = {Camera(Pose{}, 0.1, size), DepthMap(size, 1.0f), NormalMap(size, glm::vec3(0, 0, 1)),
                   ItemBuffer(size, kWall)};
    for (ibr::Warped* source : {&pair.fromFirst, &pair.fromLast}) {
      source->validity = ibr::ValidityMap(size, ibr::Validity::kValid);
      source->footprint = decltype(ibr::Warped::footprint)(size, 1.0f);
    }
  }
  WarpedPair pair;
  Mask traced{3, 1};
};

TEST_F(ProbeWeightsOfAWall, AreNothingWhereSamplesAreTracedAnyway) {
  traced(1, 0) = 1;
  EXPECT_THAT(probeWeights(pair, traced).pixels(), ElementsAre(1.0f, 0.0f, 1.0f));
}

TEST_F(ProbeWeightsOfAWall, AreHigherWhereOneKeyframeAloneShowsTheSample) {
  pair.fromLast.validity(0, 0) = ibr::Validity::kOccluded;
  EXPECT_THAT(probeWeights(pair, traced).pixels(), ElementsAre(4.0f, 1.0f, 1.0f));
}

TEST_F(ProbeWeightsOfAWall, AreHigherWhereBothStretchIt) {
  pair.fromFirst.footprint(0, 0) = pair.fromFirst.footprint(1, 0) = 2.0f;
  pair.fromLast.footprint(1, 0) = 1.6f;
  EXPECT_THAT(probeWeights(pair, traced).pixels(), ElementsAre(1.0f, 4.0f, 1.0f));
}

TEST_F(ProbeWeightsOfAWall, AreHigherWhereItIsSeenAtAGrazingAngle) {
  // 80 degrees from the normal.
  const float angle = 80.0f * std::numbers::pi_v<float> / 180.0f;
  pair.target.normal(1, 0) = glm::vec3(std::sin(angle), 0.0f, std::cos(angle));
  EXPECT_THAT(probeWeights(pair, traced).pixels(), ElementsAre(1.0f, 4.0f, 1.0f));
}

}  // namespace
}  // namespace promenade::walkthrough
