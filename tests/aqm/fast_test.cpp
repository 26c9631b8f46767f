// The fast execution against the plain one.

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "aqm/fast_bank.h"
#include "aqm/transform_plan.h"
#include "tests/aqm/fast_against_plain.h"
#include "tests/aqm/patterns.h"

namespace promenade::aqm {
namespace {

using tests::BlobScene;
using tests::frameOf;
using tests::noise;
using tests::pi;
using tests::velocityOf;

void expectClose(const tests::Departure& found, const char* what) {
  EXPECT_GT(found.largestPooled, 0.2) << what;
  EXPECT_LT(found.pooled, 0.02) << what;
  EXPECT_LT(found.probability, 0.02) << what;
  // The sums of the coarsest channels are interpolated linearly; smooth stimuli, unlike rendered frames (1 to
  // 3 %), have nothing else that fills their zeros.
  EXPECT_LT(found.sharp, 0.2) << what;
}

TEST(FastExecution, FindsWhatThePlainOneFindsInEveryCoveredSetting) {
  const Size size{203, 150};
  const LuminanceMap test = noise(size, 1, 0.5);
  const LuminanceMap reference = noise(size, 2, 0.4);
  const VelocityMap velocity =
      velocityOf(size, [](int x, int y) { return glm::dvec2(x - 100, y - 70) * 0.12; });
  std::vector<std::pair<const char*, Settings>> cases{{"aqm", aqm(30.0)}};
  const auto with = [&](const char* name, const auto& change) {
    cases.emplace_back(name, aqm(30.0));
    change(cases.back().second);
  };
  with("amplitude filters", [](Settings& s) { s.decomposition = Decomposition::kCortexAmplitude; });
  with("band centres", [](Settings& s) { s.csfPlacement = CsfPlacement::kBandCentres; });
  with("another CSF", [](Settings& s) { s.csf = Csf::kDalyMoving; });
  with("an onset", [](Settings& s) { s.onsetHertz = 2.0; });
  with("revised", [](Settings& s) { s = revisedAqm(30.0); });
  with("strong masking", [](Settings& s) { s.masking.strength = 2.0; });
  with("fixating", [](Settings& s) { s.eye = Eye::kFixating; });
  with("stabilised", [](Settings& s) { s.eye = Eye::kStabilised; });
  with("one orientation", [](Settings& s) { s.orientations = 1; });
  with("four orientations", [](Settings& s) { s.orientations = 4; });
  with("three bands", [](Settings& s) { s.radialBands = 3; });
  with("two bands", [](Settings& s) { s.radialBands = 2; });
  with("no masking", [](Settings& s) { s.masking.elevation = Elevation::kNone; });
  with("masking at a point", [](Settings& s) { s.masking.extent = MaskExtent::kPoint; });
  with("masking by the test", [](Settings& s) { s.masking.source = MaskSource::kTest; });
  with("masking by the reference", [](Settings& s) { s.masking.source = MaskSource::kReference; });
  for (const auto& [name, settings] : cases) {
    ASSERT_TRUE(speedsToRunFast(velocity, settings));
    expectClose(tests::departure(test, reference, velocity, settings), name);
    expectClose(tests::departure(test, reference, {}, settings), name);
  }
}

TEST(FastExecution, FindsWhatThePlainOneFindsOnAnySize) {
  for (const Size size : {Size{1, 90}, Size{90, 1}, Size{17, 64}, Size{65, 33}, Size{131, 7}}) {
    const VelocityMap velocity = velocityOf(size, [](int x, int y) { return glm::dvec2(0.2 * x, -0.1 * y); });
    for (const double ppd : {5.0, 16.0, 40.0, 90.0}) {
      const tests::Departure found =
          tests::departure(noise(size, 3, 1.2), noise(size, 4, 1.0), velocity, aqm(ppd));
      EXPECT_LT(found.pooled, 0.05) << size.width << " x " << size.height << " at " << ppd;
      EXPECT_LT(found.probability, 0.05) << size.width << " x " << size.height << " at " << ppd;
    }
  }
}

// A grating of one frequency is the worst case of sampling: nothing averages it out.
TEST(FastExecution, FindsWhatThePlainOneFindsInAGratingAndABlob) {
  for (const double period : {3.0, 5.0, 7.0, 10.0, 16.0, 23.0, 40.0}) {
    const Size size{160, 128};
    const LuminanceMap grating = frameOf(size, [=](int x, int y) {
      return 50.0 * (1.0 + 0.05 * std::cos(2.0 * pi * (x + 0.4 * y) / period));
    });
    const tests::Departure found =
        tests::departure(grating, frameOf(size, [](int, int) { return 50.0; }), {}, aqm(32.0));
    EXPECT_LT(found.pooled, 0.015) << period;
    EXPECT_LT(found.probability, 0.02) << period;
  }
  const BlobScene scene;
  expectClose(tests::departure(scene.withBlob, scene.plain, scene.velocity, aqm(30.0)), "moving blob");
  expectClose(tests::departure(scene.withBlob, scene.plain, {}, aqm(30.0)), "still blob");
}

TEST(FastExecution, IsSymmetricExactAndIndependentOfThreads) {
  const BlobScene scene;
  const Result forth = compare(scene.withBlob, scene.plain, scene.velocity, aqm(30.0));
  const Result back = compare(scene.plain, scene.withBlob, scene.velocity, aqm(30.0));
  EXPECT_TRUE(std::ranges::equal(forth.jnd.pixels(), back.jnd.pixels()));
  EXPECT_TRUE(std::ranges::equal(forth.pooledJnd.pixels(), back.pooledJnd.pixels()));
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Result single = compare(scene.withBlob, scene.plain, scene.velocity, aqm(30.0));
  EXPECT_TRUE(std::ranges::equal(forth.jnd.pixels(), single.jnd.pixels()));
}

// 1280 x 720 at 40 pixels per degree: K = 6, margin 32, padded to 1440 x 800. Two frames forth; back, bands 1
// to 3 in 6 orientations at full size, bands 4, 5, 6 at D = 2, 4, 8 and the baseband at 16. Plainly, 6 * 6 +
// 1 channels.
TEST(PlannedTransforms, AreThoseOfTheChannelsOfBothFrames) {
  const auto plan = plannedTransforms({1280, 720}, {}, aqm(40.0));
  ASSERT_EQ(plan.size(), 5u);
  EXPECT_EQ(plan[0].size, (Size{1440, 800}));
  EXPECT_EQ(plan[0].forward, 2);
  EXPECT_EQ(plan[0].inverse, 2 * 6 * 3);
  EXPECT_EQ(plan[3].size, (Size{180, 100}));
  EXPECT_EQ(plan[3].inverse, 2 * 6);
  EXPECT_EQ(plan[4].size, (Size{90, 50}));
  EXPECT_EQ(plan[4].inverse, 2);
  Settings plain = aqm(40.0);
  plain.execution = Execution::kPlain;
  const auto plainly = plannedTransforms({1280, 720}, {}, plain);
  ASSERT_EQ(plainly.size(), 1u);
  EXPECT_EQ(plainly[0].inverse, 2 * 37);
}

TEST(FastExecution, LeavesToThePlainOneWhatItDoesNotCover) {
  EXPECT_TRUE(speedsToRunFast({}, aqm2000(40.0)));
  EXPECT_FALSE(speedsToRunFast({}, vdp(40.0, 0.5)));
  Settings settings = aqm(40.0);
  settings.contrast = ContrastKind::kLocal;
  EXPECT_FALSE(speedsToRunFast({}, settings));
}

/// One pixel of the frame races. A tracking eye follows at up to 80 degrees a second, one at rest does not.
TEST(FastExecution, LeavesToThePlainOneWhatRacesOverTheRetina) {
  const auto racing = [](double speed) {
    return velocityOf({32, 32},
                      [speed](int x, int y) { return glm::dvec2(x == 7 && y == 9 ? speed : 1.0, 0.0); });
  };
  EXPECT_TRUE(speedsToRunFast(racing(100.0), aqm(40.0)));
  EXPECT_FALSE(speedsToRunFast(racing(102.0), aqm(40.0)));
  Settings still = aqm(40.0);
  still.eye = Eye::kFixating;
  EXPECT_TRUE(speedsToRunFast(racing(20.0), still));
  EXPECT_FALSE(speedsToRunFast(racing(22.0), still));
}

}  // namespace
}  // namespace promenade::aqm
