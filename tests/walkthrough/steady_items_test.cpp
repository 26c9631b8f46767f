#include "src/walkthrough/steady_items.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/walkthrough/analytic_renderer.h"

namespace promenade::walkthrough {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using tests::kPanel;
using tests::kWall;

constexpr int kSamples = 200;

/// 200 samples of the panel, half diffuse, half view dependent, alike in both keyframes.
class SteadyItems : public testing::Test {
 protected:
  SteadyItems() {
    const Size size{kSamples, 1};
    pair.target = {Camera(Pose{}, 1.0, size), DepthMap(size, 1.0f), NormalMap(size),
                   ItemBuffer(size, kPanel)};
    for (ibr::Warped* warped : {&pair.fromFirst, &pair.fromLast}) {
      warped->diffuse = RadianceMap(size, Rgb(0.5f));
      warped->viewDependent = RadianceMap(size, Rgb(0.5f));
      warped->validity = ibr::ValidityMap(size, ibr::Validity::kValid);
    }
    pair.disputed = Mask(size);
  }
  /// The later keyframe shows so much more of the view-dependent layer on the first `count` samples.
  void brighten(int count, float by) {
    for (int x = 0; x < count; ++x) pair.fromLast.viewDependent(x, 0) = Rgb(0.5f + by);
  }
  [[nodiscard]] std::vector<ItemId> steady() const { return steadyAmong(ItemSet({kPanel}), pair).items(); }

  WarpedPair pair;
};

TEST_F(SteadyItems, AreThoseThatLookAlikeFromBothEnds) {
  EXPECT_THAT(steady(), ElementsAre(kPanel));
}

TEST_F(SteadyItems, MayChangeByATenthOfWhatTheyShow) {
  brighten(kSamples, 0.11f);  // 0.11 of 1.11
  EXPECT_THAT(steady(), ElementsAre(kPanel));
  brighten(kSamples, 0.12f);  // 0.12 of 1.12
  EXPECT_THAT(steady(), IsEmpty());
}

TEST_F(SteadyItems, MayChangeMoreOnOneSampleInTwenty) {
  brighten(10, 0.5f);
  EXPECT_THAT(steady(), ElementsAre(kPanel));
  brighten(11, 0.5f);
  EXPECT_THAT(steady(), IsEmpty());
}

TEST_F(SteadyItems, MayChangeTheirDiffuseLayer) {
  pair.fromLast.diffuse = RadianceMap(pair.fromLast.diffuse.size(), Rgb(0.9f));
  EXPECT_THAT(steady(), ElementsAre(kPanel));
}

TEST_F(SteadyItems, DoNotComeOutDifferentlyWhenTheKeyframesAreSwapped) {
  for (const int count : {10, 11}) {
    brighten(count, 0.5f);
    WarpedPair swapped;
    swapped.target = {pair.target.camera, pair.target.depth.clone(), pair.target.normal.clone(),
                      pair.target.item.clone()};
    std::swap(pair.fromFirst, pair.fromLast);
    const std::vector<ItemId> there = steady();
    std::swap(pair.fromFirst, pair.fromLast);
    EXPECT_EQ(there, steady());
  }
}

TEST_F(SteadyItems, AreToldByWhatBothKeyframesFillAndByEnoughOfIt) {
  // What changes is filled by one alone.
  brighten(100, 0.5f);
  for (int x = 0; x < 100; ++x) pair.fromFirst.validity(x, 0) = ibr::Validity::kOccluded;
  EXPECT_THAT(steady(), ElementsAre(kPanel));
  pair.fromFirst.validity(100, 0) = ibr::Validity::kOccluded;  // 99 are left
  EXPECT_THAT(steady(), IsEmpty());
}

TEST_F(SteadyItems, WereProvenToPass) {
  EXPECT_THAT(steadyAmong(ItemSet({kWall}), pair).items(), IsEmpty());
}

}  // namespace
}  // namespace promenade::walkthrough
