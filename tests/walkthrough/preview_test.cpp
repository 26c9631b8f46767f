// The progression with a clock of its own: a path of every sample takes a second, a path of the light as long
// as one of a sample.

#include "src/walkthrough/preview.h"

#include <gtest/gtest.h>

#include "src/walkthrough/seen.h"
#include "tests/walkthrough/timed_wall.h"

namespace promenade::walkthrough {
namespace {

using tests::TimedWall;
using tests::WallLook;

constexpr Size kPreviewSize{96, 64};
constexpr auto kPreviewSamples = static_cast<std::uint64_t>(kPreviewSize.width) * kPreviewSize.height;
const Camera kPreviewCamera(Pose{}, 1.0, kPreviewSize);

Settings previewSettings() {
  Settings s;
  s.size = kPreviewSize;
  s.supersample = 1;
  return s;
}

struct LightLevel {
  double announced = 4.0;  ///< seconds
  double taken = 4.0;
  WallLook look = {.contrast = 0.0, .gain = 1.0, .secondsPerPath = 0.25, .seed = 2};
};

struct AskedOfLight {
  int made = 0;
  int placed = 0;
  int gathered = 0;
};

class ScriptedLight final : public SteppedLight {
 public:
  ScriptedLight(std::vector<LightLevel> levels, AskedOfLight& asked, double& now)
      : levels_(std::move(levels)), asked_(asked), now_(now) {
    ++asked_.made;
  }
  [[nodiscard]] int levelsLeft() const override { return static_cast<int>(levels_.size() - next_); }
  std::uint64_t place(const Checkpoint& checkpoint) override {
    checkpoint();
    ++asked_.placed;
    return static_cast<std::uint64_t>(levels_[next_].announced * static_cast<double>(kPreviewSamples));
  }
  void gather(const Checkpoint& checkpoint, const MayTrace&) override {
    for (int i = 0; i < 1000; ++i) {
      now_ += levels_[next_].taken / 1000;
      checkpoint();
    }
    ++next_;
    ++asked_.gathered;
  }
  [[nodiscard]] std::unique_ptr<const Renderer> renderer() const override {
    return std::make_unique<TimedWall>(levels_[next_ - 1].look, now_);
  }

 private:
  std::vector<LightLevel> levels_;
  AskedOfLight& asked_;
  double& now_;
  std::size_t next_ = 0;
};

struct Previewed {
  Preview preview;
  AskedOfLight asked;
  double error = 0.0;  ///< the true one
};

Previewed previewed(double budget, double contrast, const std::vector<LightLevel>& levels) {
  Previewed outcome;
  double now = 0.0;
  const TimedWall paths({.contrast = contrast}, now);
  MakeSteppedLight makeLight;
  if (!levels.empty()) {
    makeLight = [&] { return std::make_unique<ScriptedLight>(levels, outcome.asked, now); };
  }
  PreviewRule rule;
  rule.budgetSeconds = budget;
  const Settings s = previewSettings();
  outcome.preview = preview(paths, makeLight, kPreviewCamera, s, rule, [&] { return now; });
  Frame truth = unshaded(paths.visibility(kPreviewCamera));
  for (Rgb& value : truth.diffuse.pixels()) value = Rgb(static_cast<float>(TimedWall::kGrey));
  outcome.error = rmsContrast(seenOnDisplay(outcome.preview.frame, 0, s), seenOnDisplay(truth, 0, s));
  return outcome;
}

TEST(Preview, OfABudgetForNothingIsOnePathOfEverySample) {
  const Previewed o = previewed(0.01, 1.0, {LightLevel{}});
  EXPECT_EQ(o.preview.paths, 1);
  EXPECT_EQ(o.preview.stage, PreviewStage::kStochastic);
  EXPECT_DOUBLE_EQ(o.preview.seconds, 1.0);
  EXPECT_FALSE(o.preview.error);
  EXPECT_EQ(o.asked.made, 0);
}

TEST(Preview, KeepsToItsBudget) {
  for (double budget = 1.0; budget < 60.0; budget *= 1.3) {
    SCOPED_TRACE(budget);
    for (const auto& levels :
         {std::vector<LightLevel>{}, std::vector<LightLevel>{LightLevel{}, LightLevel{8.0, 8.0}},
          std::vector<LightLevel>{LightLevel{4.0, 30.0}}}) {
      const Previewed o = previewed(budget, 1.0, levels);
      EXPECT_LE(o.preview.seconds, budget + 1e-9);
      EXPECT_GE(o.preview.paths, 1);
    }
  }
}

TEST(Preview, SwitchesWhenTheHeuristicSaysSo) {
  // T_i0 = 4 s for the light and 1 s for a picture. T_alpha = max(0.1 * 5, 0.5) = 0.5 s; the first path takes
  // longer and tells nothing of the error, so there are two. A contrast of 1 then leaves an error far above
  // 0.15: at 0.5 s (E / 0.15)^2 > 5 s from E = 0.47 on, so T_1 = T_i0 = 5 s.
  const Previewed noisy = previewed(100.0, 1.0, {LightLevel{}});
  EXPECT_DOUBLE_EQ(noisy.preview.stochasticSeconds, 5.0);
  EXPECT_DOUBLE_EQ(noisy.preview.switchedSeconds.value(), 5.0);
  EXPECT_EQ(noisy.preview.stage, PreviewStage::kComputed);
  EXPECT_EQ(noisy.preview.levelsLeft, 0);
  // With little noise it is 15 per cent before T_alpha.
  const Previewed quiet = previewed(100.0, 0.15, {LightLevel{}});
  EXPECT_DOUBLE_EQ(quiet.preview.switchedSeconds.value(), 2.0);
  EXPECT_EQ(quiet.asked.gathered, 1);
}

TEST(Preview, DoesNotSwitchSoLateThatNothingComesOfIt) {
  // Of 8 s two are gone when the error is known: (8 - 2) / 1.1 = 5.45 s are left, 5 of them for the light and
  // its picture, and no other path fits before.
  const Previewed o = previewed(8.0, 1.0, {LightLevel{}});
  EXPECT_DOUBLE_EQ(o.preview.switchedSeconds.value(), 2.0);
  EXPECT_EQ(o.preview.stage, PreviewStage::kComputed);
}

TEST(Preview, DoesNotBeginLightThatWouldBeLate) {
  // (6 - 2) / 1.1 = 3.6 s are left for the 5 that are needed: three paths instead.
  const Previewed o = previewed(6.0, 1.0, {LightLevel{}});
  EXPECT_EQ(o.asked.gathered, 0);
  EXPECT_FALSE(o.preview.switchedSeconds);
  EXPECT_EQ(o.preview.stage, PreviewStage::kStochastic);
  EXPECT_EQ(o.preview.paths, 5);
}

TEST(Preview, IsThePathTracedPictureWhereLightTurnsOutToBeLate) {
  const Previewed o = previewed(12.0, 1.0, {LightLevel{4.0, 1000.0}});
  EXPECT_EQ(o.asked.gathered, 0);
  EXPECT_EQ(o.preview.stage, PreviewStage::kStochastic);
  EXPECT_GE(o.preview.paths, 5);
  EXPECT_LE(o.preview.seconds, 12.0);
}

TEST(Preview, TakesNoLightThatIsFartherFromTheTruthThanPaths) {
  const auto of = [](double gain) {
    LightLevel level;
    level.look.gain = gain;
    return previewed(40.0, 0.3, {level}).preview;
  };
  // Two paths leave a relative deviation of 0.3 / sqrt(2) = 0.21; a wrong grey's
  // is 1 - 1 / gain.
  EXPECT_EQ(of(1.05).stage, PreviewStage::kComputed);
  EXPECT_EQ(of(0.9).stage, PreviewStage::kComputed);
  EXPECT_EQ(of(1.5).stage, PreviewStage::kStochastic);
  EXPECT_EQ(of(0.5).stage, PreviewStage::kStochastic);
  EXPECT_GT(of(1.5).paths, 20);
}

TEST(Preview, TellsHowFarItIsFromTheTruth) {
  LightLevel wrong;
  wrong.look.gain = 1.1;
  const Previewed traced = previewed(20.0, 0.3, {});
  EXPECT_NEAR(traced.preview.error.value(), traced.error, 0.15 * traced.error);
  // 1 - 1 / 1.1 = 0.091, known to E_A E_B / sqrt(6144) = 0.2 * 0.2 / 78 in its square: 0.0083 + 2 * 0.0005.
  const Previewed computed = previewed(40.0, 0.2, {wrong});
  EXPECT_EQ(computed.preview.stage, PreviewStage::kComputed);
  EXPECT_NEAR(computed.preview.error.value(), 0.096, 0.01);
}

TEST(Preview, GoesOnToTheLastLevelAndEndsWhenNothingIsToBeSeen) {
  const Previewed o = previewed(1000.0, 1.0, {LightLevel{}, LightLevel{8.0, 8.0}, LightLevel{16.0, 16.0}});
  EXPECT_EQ(o.asked.gathered, 3);
  EXPECT_EQ(o.preview.stage, PreviewStage::kContinued);
  EXPECT_EQ(o.preview.levelsLeft, 0);
  EXPECT_EQ(o.preview.predictedPercent, 0.0);
  // 5 s of paths, the levels, a path of a quarter of a second after each.
  EXPECT_NEAR(o.preview.seconds, 5.0 + 4.0 + 8.0 + 16.0 + 3 * 0.25, 0.1);
}

TEST(Preview, LeavesHalfOfTheTimeToReflectionsThatAreStillNoisy) {
  LightLevel noisy;
  noisy.look.contrast = 0.5;
  LightLevel finer = noisy;
  finer.announced = finer.taken = 8.0;
  // After the first level some 9.25 s are gone: of 20 s (20 - 9.25) / 1.1 / 2 = 4.9 s may be spent on the
  // next, of 40 s 14.
  EXPECT_EQ(previewed(20.0, 1.0, {noisy, finer}).asked.gathered, 1);
  EXPECT_EQ(previewed(40.0, 1.0, {noisy, finer}).asked.gathered, 2);
}

TEST(Preview, OfALargerBudgetIsNearerToTheConvergedPicture) {
  LightLevel first;
  first.look = {.contrast = 0.2, .gain = 1.04, .secondsPerPath = 0.25, .seed = 3};
  LightLevel second{8.0, 8.0, {.contrast = 0.2, .gain = 1.01, .secondsPerPath = 0.25, .seed = 4}};
  double before = 10.0;
  for (const double budget : {1.0, 2.5, 5.0, 12.0, 60.0, 600.0}) {
    SCOPED_TRACE(budget);
    const double error = previewed(budget, 1.0, {first, second}).error;
    EXPECT_LT(error, before);
    before = error;
  }
}

TEST(Preview, ShowsKnownLightFromTheFirstPathOn) {
  PreviewRule rule;
  rule.budgetSeconds = 5.0;
  const Settings s = previewSettings();
  const auto of = [&](double contrast) {
    double now = 0.0;
    const TimedWall lit({.contrast = contrast, .secondsPerPath = 0.25, .seed = 2}, now);
    return previewByKnownLight(lit, kPreviewCamera, s, rule, [&] { return now; });
  };
  const Preview clean = of(0.0);
  EXPECT_EQ(clean.stage, PreviewStage::kContinued);
  EXPECT_EQ(clean.levelsLeft, 0);
  EXPECT_FALSE(clean.switchedSeconds);
  EXPECT_FALSE(clean.error);
  EXPECT_DOUBLE_EQ(clean.predictedPercent.value(), 0.0);
  EXPECT_NEAR(clean.seconds, 0.25, 1e-9);
  // Noisy reflections take what there is: a pass is begun if 1.1 times its time is left.
  const Preview noisy = of(1.0);
  EXPECT_GE(noisy.paths, 16);
  EXPECT_LE(noisy.seconds, rule.budgetSeconds);
  EXPECT_DOUBLE_EQ(noisy.stochasticSeconds, 0.0);
}

}  // namespace
}  // namespace promenade::walkthrough
