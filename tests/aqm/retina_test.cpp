#include "aqm/retina.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>

#include "aqm/cortex.h"
#include "aqm/csf.h"
#include "aqm/speed_field.h"

namespace promenade::aqm {
namespace {

using Speeds = std::array<double, 7>;  // orientations 0..5, then the baseband

double speedOf(glm::dvec2 retinal, int orientation) {
  return orientation == kOrientations ? channelSpeed(retinal, kDriftSpeed)
                                      : channelSpeed(retinal, acrossBars(orientation), kDriftSpeed);
}

void expectSpeeds(glm::dvec2 imageVelocity, const Speeds& expected) {
  const glm::dvec2 retinal = retinalVelocity(imageVelocity);
  for (int l = 0; l <= kOrientations; ++l) {
    EXPECT_NEAR(speedOf(retinal, l), expected[static_cast<std::size_t>(l)], 1e-4) << "orientation " << l;
  }
}

TEST(ChannelSpeed, NeverFallsBelowTheDriftOfTheEye) {
  expectSpeeds({0.0, 0.0}, {.15, .15, .15, .15, .15, .15, .15});
  // The eye follows at 0.82 * 0.5 + 0.15 = 0.56 degrees per second: 0.06 are left on the retina.
  expectSpeeds({0.5, 0.0}, {.15, .15, .15, .15, .15, .15, .15});
}

// Followed at 0.82 * 10 + 0.15 = 8.35: 1.65 are left; 1.65 cos 30 = 1.4289, 1.65 cos 60 = 0.825.
TEST(ChannelSpeed, IsThatAcrossTheBars) {
  expectSpeeds({10.0, 0.0}, {1.65, 1.4289, .825, .15, .825, 1.4289, 1.65});
}

// |(3, -4)| = 5 is followed at 4.25: (3, -4) * 0.15 = (0.45, -0.6) is left. At 30 degrees: |0.45 cos 30 - 0.6
// sin 30| = 0.08971, and at 60: |0.225 - 0.51962| = 0.29462.
TEST(ChannelSpeed, HasTheDirectionOfTheMotion) {
  expectSpeeds({3.0, -4.0}, {.45, .15, .29462, .6, .74462, .68971, .75});
}

TEST(ChannelSpeed, IsWhatTheEyesFastestPursuitLeavesOver) {
  // 120 - 80 = 40.
  expectSpeeds({0.0, 120.0}, {.15, 20.0, 34.641, 40.0, 34.641, 20.0, 40.0});
}

TEST(ChannelSpeed, DoesNotDependOnTheSignOfTheMotion) {
  for (int l = 0; l <= kOrientations; ++l) {
    EXPECT_EQ(speedOf(retinalVelocity({3.0, -40.0}), l), speedOf(retinalVelocity({-3.0, 40.0}), l));
  }
}

// An eye that does not follow gets the whole motion; one whose drift is taken away as well, nothing else.
TEST(RetinalVelocity, IsTheImagesWhereTheEyeDoesNotFollow) {
  EXPECT_EQ(retinalVelocity({3.0, -4.0}, Eye::kFixating), glm::dvec2(3.0, -4.0));
  EXPECT_EQ(retinalVelocity({3.0, -4.0}, Eye::kStabilised), glm::dvec2(3.0, -4.0));
  EXPECT_EQ(slowestSpeed(Eye::kTracking), 0.15);
  EXPECT_EQ(slowestSpeed(Eye::kFixating), 0.15);
  EXPECT_EQ(slowestSpeed(Eye::kStabilised), 0.15 / 16.0);
}

// 0.15 / 16 doubles 17 times to 1228.8.
TEST(SpeedField, OfAStabilisedEyeStartsSlowerAndEndsAtTheSameSpeed) {
  const SpeedLevels tracking = speedLevels(Eye::kTracking);
  const SpeedLevels stabilised = speedLevels(Eye::kStabilised);
  EXPECT_EQ(tracking.last, 13);
  EXPECT_EQ(stabilised.last, 17);
  EXPECT_DOUBLE_EQ(tracking.speed(13), 1228.8);
  EXPECT_DOUBLE_EQ(stabilised.speed(17), 1228.8);
  const SpeedField still = speedField({}, {2, 1}, 0, kOrientations, Eye::kStabilised);
  EXPECT_FLOAT_EQ(still.speed.row(0)[1], 0.009375f);
  EXPECT_EQ(still.levels, 1u);
  // 0.15 = 2^4 times that.
  const SpeedField drifting =
      speedField(VelocityMap(1, 1, {0.15f, 0.0f}), {1, 1}, 0, kOrientations, Eye::kStabilised);
  EXPECT_NEAR(drifting.octave.row(0)[0], 4.0, 1e-6);
}

TEST(SpeedField, IsAllDriftWhereNothingMoves) {
  const SpeedField field = speedField({}, {5, 3}, 2);
  EXPECT_EQ(field.levels, 1u);
  for (int x = 0; x < 5; ++x) {
    EXPECT_EQ(field.speed.row(2)[x], 0.15f);
    EXPECT_EQ(field.octave.row(2)[x], 0.0f);
    EXPECT_NEAR(field.gain.row(2)[x], speedGain(0.15), 1e-6 * speedGain(0.15));
  }
  EXPECT_EQ(field.gain.row(2)[5], 0.0f);  // beyond the image
}

TEST(SpeedField, NamesTheLevelsThatHaveAWeight) {
  VelocityMap retinal(2, 3);
  retinal(1, 0) = {1.0f, 0.0f};   // log2(1 / 0.15) = 2.737: levels 2 and 3
  retinal(0, 1) = {0.0f, 50.0f};  // along the bars: level 0
  retinal(0, 2) = {1e30f, 0.0f};  // as the fastest
  const SpeedField field = speedField(retinal, {2, 3}, 0);
  EXPECT_EQ(field.levelsOfRow, (std::vector<std::uint32_t>{0b1101u, 1u, 1u | 1u << 13}));
  EXPECT_EQ(field.levels, 0b1101u | 1u << 13);
  EXPECT_NEAR(field.octave.row(0)[1], 2.736966, 1e-5);
  EXPECT_EQ(field.steps.speed(3), 1.2);
  EXPECT_FLOAT_EQ(field.speed.row(2)[0], static_cast<float>(field.steps.speed(13)));
}

// 2 Hz of 4 cycles per degree are 0.5 degrees per second: hypot(0.15, 0.5) = 0.522 where nothing moves,
// hypot(1.2, 0.5) = 1.3 where 1.2 do; log2(1.3 / 0.15) = 3.115, between levels 3 and 4, log2(0.522 / 0.15)
// = 1.799.
TEST(SpeedField, HasAnOnsetInQuadrature) {
  VelocityMap retinal(2, 1);
  retinal(1, 0) = {1.2f, 0.0f};
  EXPECT_EQ(onsetSpeed(2.0, 4.0), 0.5);
  const SpeedField field =
      speedField(retinal, retinal.size(), 0, kOrientations, Eye::kFixating, onsetSpeed(2.0, 4.0));
  EXPECT_NEAR(field.speed.row(0)[0], 0.522, 1e-3);
  EXPECT_NEAR(field.octave.row(0)[0], 1.799, 1e-3);
  EXPECT_NEAR(field.speed.row(0)[1], 1.3, 1e-6);
  EXPECT_NEAR(field.octave.row(0)[1], 3.115, 1e-3);
  EXPECT_EQ(field.levels, 0b11110u);
  EXPECT_NEAR(field.gain.row(0)[1], speedGain(1.3), 1e-4 * speedGain(1.3));
}

TEST(SpeedField, TakesTheEyesPursuitOff) {
  VelocityMap image(1, 1);
  image(0, 0) = {3.0f, -4.0f};
  const VelocityMap retinal = retinalVelocities(image);
  EXPECT_NEAR(retinal(0, 0).x, 0.45, 1e-6);
  EXPECT_NEAR(retinal(0, 0).y, -0.6, 1e-6);
  EXPECT_TRUE(retinalVelocities({}).empty());
}

}  // namespace
}  // namespace promenade::aqm
