#include "src/walkthrough/judge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "tests/walkthrough/analytic_renderer.h"

namespace promenade::walkthrough {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using tests::AnalyticRenderer;
using tests::kPanel;
using tests::kWall;
using tests::Panel;

ibr::Warped warpedOf(Size size, Rgb radiance, ItemId item) {
  ibr::Warped warped;
  warped.diffuse = RadianceMap(size, radiance);
  warped.viewDependent = RadianceMap(size);
  warped.depth = DepthMap(size, 1.0f);
  warped.item = ItemBuffer(size, item);
  warped.validity = ibr::ValidityMap(size, ibr::Validity::kValid);
  return warped;
}

WarpedPair pairOf(Size size) {
  WarpedPair pair;
  pair.target = {Camera(Pose{}, 1.0, size), DepthMap(size, 1.0f), NormalMap(size), ItemBuffer(size, kWall)};
  pair.fromFirst = warpedOf(size, Rgb(0.25f), kWall);
  pair.fromLast = warpedOf(size, Rgb(0.75f), kWall);
  pair.disputed = Mask(size);
  return pair;
}

TEST(ComparedPair, KeepsBothValuesWhereBothKeyframesFill) {
  const ComparedPair pair = comparedPair(pairOf({1, 1}), ItemSet(), Mask(1, 1));
  EXPECT_EQ(pair.fromFirst(0, 0), Rgb(0.25f));
  EXPECT_EQ(pair.fromLast(0, 0), Rgb(0.75f));
  EXPECT_EQ(pair.excluded(0, 0), 0);
  EXPECT_EQ(pair.unverified(0, 0), 0);
}

TEST(ComparedPair, GivesBothImagesTheOnlyValueThereIs) {
  WarpedPair warped = pairOf({2, 1});
  warped.fromFirst.validity(0, 0) = ibr::Validity::kOccluded;
  warped.fromLast.validity(1, 0) = ibr::Validity::kOutside;
  const ComparedPair pair = comparedPair(warped, ItemSet(), Mask(2, 1));
  EXPECT_EQ(pair.fromFirst(0, 0), Rgb(0.75f));
  EXPECT_EQ(pair.fromLast(0, 0), Rgb(0.75f));
  EXPECT_EQ(pair.fromFirst(1, 0), Rgb(0.25f));
  EXPECT_EQ(pair.fromLast(1, 0), Rgb(0.25f));
  EXPECT_EQ(pair.unverified(0, 0), 1);
  EXPECT_EQ(pair.unverified(1, 0), 1);
  EXPECT_EQ(pair.excluded(0, 0), 0);
}

TEST(ComparedPair, FillsHolesAlikeAndExcludesThem) {
  WarpedPair warped = pairOf({3, 1});
  warped.fromFirst.validity(1, 0) = ibr::Validity::kOccluded;
  warped.fromLast.validity(1, 0) = ibr::Validity::kUndersampled;
  const ComparedPair pair = comparedPair(warped, ItemSet(), Mask(3, 1));
  // The mean of what is valid: two samples of 0.25 and two of 0.75.
  EXPECT_EQ(pair.fromFirst(1, 0), Rgb(0.5f));
  EXPECT_EQ(pair.fromLast(1, 0), Rgb(0.5f));
  EXPECT_EQ(pair.excluded(1, 0), 1);
  EXPECT_EQ(pair.unverified(1, 0), 0);
}

TEST(ComparedPair, SilencesItemsThatAreTraced) {
  WarpedPair warped = pairOf({2, 1});
  warped.target.item(1, 0) = kPanel;
  const ComparedPair pair = comparedPair(warped, ItemSet({kPanel}), Mask(2, 1));
  EXPECT_EQ(pair.excluded(0, 0), 0);
  EXPECT_EQ(pair.excluded(1, 0), 1);
  EXPECT_EQ(pair.fromFirst(1, 0), pair.fromLast(1, 0));
}

TEST(ComparedPair, SilencesDisputedSamples) {
  Mask disputed(2, 1);
  disputed(1, 0) = 1;
  const ComparedPair pair = comparedPair(pairOf({2, 1}), ItemSet(), disputed);
  EXPECT_EQ(pair.excluded(0, 0), 0);
  EXPECT_EQ(pair.excluded(1, 0), 1);
  EXPECT_EQ(pair.fromFirst(1, 0), pair.fromLast(1, 0));
}

TEST(ResolveMask, SelectsAPixelWithMoreThanHalfOfItsSamples) {
  Mask samples(4, 2);
  samples(0, 0) = samples(1, 0) = 1;                  // two of four: not selected
  samples(2, 0) = samples(3, 0) = samples(2, 1) = 1;  // three of four: selected
  const Mask pixels = resolveMask(samples, 2);
  EXPECT_EQ(pixels(0, 0), 0);
  EXPECT_EQ(pixels(1, 0), 1);
}

class JudgeItems : public testing::Test {
 protected:
  AnalyticRenderer renderer{Panel::kMirrorLike};
  ProbabilityMap probability{30, 1};
  ItemBuffer item{30, 1, kPanel};
  Mask excluded{30, 1};
  Mask unverified{30, 1};
};

TEST_F(JudgeItems, FailsAnItemWithMoreVisiblePixelsThanTheTolerance) {
  for (int x = 0; x < 6; ++x) probability(x, 0) = 0.9f;  // 20 per cent
  EXPECT_THAT(judgeItems(probability, item, excluded, unverified, renderer, 19.0).failing.items(),
              ElementsAre(kPanel));
  EXPECT_THAT(judgeItems(probability, item, excluded, unverified, renderer, 20.0).failing.items(), IsEmpty());
  EXPECT_THAT(judgeItems(probability, item, excluded, unverified, renderer, 20.0).proven.items(),
              ElementsAre(kPanel));
}

TEST_F(JudgeItems, NeverListsItemsThatLookTheSameFromEverywhere) {
  const AnalyticRenderer matt{Panel::kMatt};
  probability = ProbabilityMap(30, 1, 1.0f);
  const ItemVerdict verdict = judgeItems(probability, item, excluded, unverified, matt, 1.0);
  EXPECT_TRUE(verdict.failing.empty());
  EXPECT_TRUE(verdict.proven.empty());
}

TEST_F(JudgeItems, KnowsNothingOfItemsThatCouldNotBeCompared) {
  unverified = Mask(30, 1, 1);
  const ItemVerdict verdict = judgeItems(probability, item, excluded, unverified, renderer, 1.0);
  EXPECT_TRUE(verdict.failing.empty());
  EXPECT_TRUE(verdict.proven.empty());
}

TEST_F(JudgeItems, TakeNothingForProvenByTheLookOfAFewPixels) {
  for (int x = 24; x < 30; ++x) item(x, 0) = kNoItem;
  const auto verdict = [&] { return judgeItems(probability, item, excluded, unverified, renderer, 3.0); };
  EXPECT_TRUE(verdict().proven.empty());
  EXPECT_TRUE(verdict().failing.empty());
  item(24, 0) = kPanel;
  EXPECT_THAT(verdict().proven.items(), ElementsAre(kPanel));
  // One of 24 is more than 3 per cent.
  item(24, 0) = kNoItem;
  probability(0, 0) = 0.9f;
  EXPECT_THAT(verdict().failing.items(), ElementsAre(kPanel));
}

Settings settingsFor(Size size) {
  Settings settings;
  settings.size = size;
  settings.supersample = 1;
  settings.tone.curve = ToneCurve::kLinear;
  return settings;
}

TEST(JudgeMiddle, AcceptsEqualWarps) {
  const Size size{40, 30};
  WarpedPair warped = pairOf(size);
  warped.fromLast = warpedOf(size, Rgb(0.25f), kWall);
  const AnalyticRenderer renderer{Panel::kMatt};
  const Judgement judgement = judgeMiddle({0, 8, 0}, warped, VelocityMap(), renderer, settingsFor(size));
  EXPECT_EQ(judgement.statistics.decision, Decision::kAccept);
  EXPECT_EQ(judgement.statistics.differencePercent, 0.0);
  EXPECT_EQ(judgement.statistics.maskedPercent, 0.0);
}

TEST(JudgeMiddle, SeesBothWarpsWithOneEyeThatIsInTheMiddle) {
  const Size size{40, 30};
  WarpedPair warped = pairOf(size);
  warped.fromFirst = warpedOf(size, Rgb(0.25f), kWall);
  warped.fromLast = warpedOf(size, Rgb(0.3f), kWall);
  Settings settings = settingsFor(size);
  settings.tone.candelasPerUnit = 100.0;
  // Bright in the middle of the segment only.
  settings.tone.adaptation = AdaptationCurve({{0, 3.0}, {3, 3.0}, {4, 300.0}, {5, 3.0}, {8, 3.0}}, 25.0);
  const AnalyticRenderer renderer{Panel::kMatt};
  for (const ToneCurve curve : {ToneCurve::kWard, ToneCurve::kFerwerda, ToneCurve::kChiu}) {
    settings.tone.curve = curve;
    const FrameTone tone = settings.tone.at(4, settings.display);
    const RadianceMap one(size, Rgb(0.25f));
    const RadianceMap other(size, Rgb(0.3f));
    const Surroundings both = tone.around({&one, &other});
    const Judgement judgement = judgeMiddle({0, 8, 0}, warped, VelocityMap(), renderer, settings);
    EXPECT_EQ(judgement.middle.fromFirst(9, 7), encodeForDisplay(one, tone, both)(9, 7)) << nameOf(curve);
    EXPECT_EQ(judgement.middle.fromLast(9, 7), encodeForDisplay(other, tone, both)(9, 7)) << nameOf(curve);
    EXPECT_NE(judgement.middle.fromFirst(9, 7), judgement.middle.fromLast(9, 7)) << nameOf(curve);
  }
}

/// Stripes of eight pixels whose contrast differs by a third between the warps: far above threshold.
WarpedPair stripedPair(Size size) {
  WarpedPair warped = pairOf(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const bool bright = (x / 8) % 2 == 0;
      warped.fromFirst.diffuse(x, y) = Rgb(bright ? 0.6f : 0.2f);
      warped.fromLast.diffuse(x, y) = Rgb(bright ? 0.5f : 0.3f);
    }
  }
  warped.disputed = disputedSamples(warped);
  return warped;
}

TEST(JudgeMiddle, SplitsWhereAViewerSeesADifference) {
  const Size size{96, 64};
  const AnalyticRenderer renderer{Panel::kMatt};
  const Judgement judgement =
      judgeMiddle({0, 8, 0}, stripedPair(size), VelocityMap(), renderer, settingsFor(size));
  EXPECT_EQ(judgement.statistics.decision, Decision::kSplit);
  EXPECT_GT(judgement.statistics.differencePercent, 50.0);
}

/// Lines that each keyframe shows elsewhere, one every 24 columns from 6 to `end`.
WarpedPair linedPair(Size size, int end) {
  WarpedPair warped = pairOf(size);
  warped.fromLast = warpedOf(size, Rgb(0.25f), kWall);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 6; x < end; x += 24) {
      warped.fromFirst.diffuse(x, y) = Rgb(0.9f);
      warped.fromLast.diffuse(x + 1, y) = Rgb(0.9f);
    }
  }
  warped.disputed = disputedSamples(warped);
  return warped;
}

TEST(JudgeMiddle, HasAFewDisputedSamplesOfAMattItemTracedInsteadOfSplitting) {
  const Size size{96, 64};
  const WarpedPair warped = linedPair(size, 24);
  const AnalyticRenderer renderer{Panel::kMatt};
  Settings settings = settingsFor(size);
  const Judgement judgement = judgeMiddle({0, 8, 0}, warped, VelocityMap(), renderer, settings);
  EXPECT_EQ(judgement.statistics.decision, Decision::kAccept);
  EXPECT_EQ(judgement.items.disputes, Disputes::kOfAllItems);
  EXPECT_EQ(judgement.statistics.differencePercent, 0.0);
  EXPECT_NEAR(judgement.statistics.maskedPercent, 100.0 * 2 / 96, 1e-9);
  // Where they cannot be traced they are seen.
  settings.holes = Holes::kStay;
  const Judgement untraced = judgeMiddle({0, 8, 0}, warped, VelocityMap(), renderer, settings);
  EXPECT_EQ(untraced.statistics.decision, Decision::kSplit);
  EXPECT_GT(untraced.statistics.differencePercent, settings.tolerancePercent);
}

TEST(JudgeMiddle, SplitsWherePatternsThatTheSamplesMissAreSeenAllOverThePicture) {
  const Size size{96, 64};
  const AnalyticRenderer renderer{Panel::kMatt};
  const Judgement judgement =
      judgeMiddle({0, 8, 0}, linedPair(size, size.width), VelocityMap(), renderer, settingsFor(size));
  EXPECT_EQ(judgement.statistics.decision, Decision::kSplit);
  EXPECT_EQ(judgement.items.disputes, Disputes::kOfViewDependentItems);
  EXPECT_GT(judgement.statistics.differencePercent, 50.0);
}

TEST(JudgeMiddle, MasksAFailingItemInsteadOfSplitting) {
  const Size size{96, 64};
  WarpedPair warped = stripedPair(size);
  // The difference is on the panel only; the rest of the two images is equal.
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const bool onPanel = x >= 32 && x < 64;
      if (onPanel) {
        warped.target.item(x, y) = kPanel;
      } else {
        warped.fromLast.diffuse(x, y) = warped.fromFirst.diffuse(x, y);
      }
    }
  }
  const AnalyticRenderer renderer{Panel::kMirrorLike};
  warped.disputed = disputedSamples(warped);
  const Judgement judgement = judgeMiddle({0, 8, 0}, warped, VelocityMap(), renderer, settingsFor(size));
  EXPECT_THAT(judgement.items.failing.items(), ElementsAre(kPanel));
  EXPECT_EQ(judgement.statistics.decision, Decision::kAccept);
  // Evaluated anew with equal panels the images are equal: nothing leaks out of the mask.
  EXPECT_EQ(judgement.statistics.differencePercent, 0.0);
  EXPECT_NEAR(judgement.statistics.maskedPercent, 100.0 * 32 / 96, 1e-9);
  EXPECT_THAT(judgement.items.matt.items(), ElementsAre(kPanel));
}

TEST(JudgeMiddle, SaysThatOnlyTheViewDependentLayerOfAnItemFailed) {
  const Size size{96, 64};
  WarpedPair warped = stripedPair(size);
  warped.target.item = ItemBuffer(size, kPanel);
  for (ibr::Warped* source : {&warped.fromFirst, &warped.fromLast}) {
    std::swap(source->diffuse, source->viewDependent);
    source->diffuse = RadianceMap(size, Rgb(0.1f));
  }
  const AnalyticRenderer renderer{Panel::kMirrorLike};
  warped.disputed = disputedSamples(warped);
  const Judgement judgement = judgeMiddle({0, 8, 0}, warped, VelocityMap(), renderer, settingsFor(size));
  EXPECT_THAT(judgement.items.failing.items(), ElementsAre(kPanel));
  EXPECT_THAT(judgement.items.matt.items(), IsEmpty());
}

TEST(DiffuseCompared, LeavesTheDiffuseLayerToDiffer) {
  WarpedPair warped = pairOf({2, 1});
  warped.target.item(1, 0) = kPanel;
  warped.fromFirst.viewDependent = RadianceMap({2, 1}, Rgb(1.0f));
  warped.fromLast.viewDependent = RadianceMap({2, 1}, Rgb(2.0f));
  const ComparedPair pair =
      diffuseCompared(comparedPair(warped, ItemSet(), Mask(2, 1)), warped, ItemSet({kPanel}));
  EXPECT_EQ(pair.fromFirst(1, 0), Rgb(1.25f));
  EXPECT_EQ(pair.fromLast(1, 0), Rgb(1.75f));  // 0.75 diffuse, 1 as in the first
  EXPECT_EQ(pair.fromLast(0, 0), Rgb(2.75f));
}

}  // namespace
}  // namespace promenade::walkthrough
