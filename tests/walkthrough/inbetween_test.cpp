#include "src/walkthrough/inbetween.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/walkthrough/analytic_renderer.h"

namespace promenade::walkthrough {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using tests::AnalyticRenderer;
using tests::kPanel;
using tests::kWall;
using tests::Panel;

class SelectRetrace : public testing::Test {
 protected:
  SelectRetrace() : item(4, 1, kWall), holes(4, 1), source(4, 1, SampleSource::kBlended) {
    item(1, 0) = item(2, 0) = kPanel;
    holes(2, 0) = holes(3, 0) = 1;
  }
  [[nodiscard]] Retrace selectOf(const Renderer& renderer, const ItemVerdict& verdict) const {
    return selectRetrace(holes, source, disputed, trustIn(item, verdict, renderer));
  }
  [[nodiscard]] Retrace select(const ItemVerdict& verdict) const { return selectOf(mirror, verdict); }

  AnalyticRenderer mirror{Panel::kMirrorLike};  // the panel; the wall looks the same from everywhere
  ItemBuffer item;
  Mask holes;
  SourceMap source;
  Mask disputed{4, 1};
};

TEST_F(SelectRetrace, TracesHolesAndFailingItemsOnce) {
  const Retrace retrace = select({ItemSet({kPanel}), ItemSet()});
  EXPECT_THAT(retrace.holes.pixels(), ElementsAre(0, 0, 1, 1));
  EXPECT_THAT(retrace.items.pixels(), ElementsAre(0, 1, 0, 0));
}

TEST_F(SelectRetrace, TracesViewDependentItemsThatWereNeverCompared) {
  const Retrace retrace = select({});
  EXPECT_THAT(retrace.items.pixels(), ElementsAre(0, 1, 0, 0));
}

TEST_F(SelectRetrace, WarpsItemsThatWereProven) {
  const Retrace retrace = select({ItemSet(), ItemSet({kPanel})});
  EXPECT_THAT(retrace.items.pixels(), ElementsAre(0, 0, 0, 0));
}

TEST_F(SelectRetrace, TracesWhatOfAProvenItemOneKeyframeAloneFills) {
  source(0, 0) = source(1, 0) = SampleSource::kWarpedFromNext;  // the wall and the panel
  const Retrace retrace = select({ItemSet(), ItemSet({kPanel})});
  EXPECT_THAT(retrace.items.pixels(), ElementsAre(0, 1, 0, 0));
}

TEST_F(SelectRetrace, WarpsWhatOfASteadyItemOneKeyframeAloneFillsButNotWhatIsDisputed) {
  source = SourceMap(4, 1, SampleSource::kWarpedFromNext);
  holes = Mask(4, 1);
  disputed(2, 0) = 1;
  ItemVerdict verdict;
  verdict.proven = verdict.steady = ItemSet({kPanel});
  const Retrace retrace = select(verdict);
  EXPECT_THAT(retrace.items.pixels(), ElementsAre(0, 0, 1, 0));
}

TEST_F(SelectRetrace, TracesWhatOfAProvenItemTheKeyframesContradictEachOtherIn) {
  disputed(1, 0) = disputed(2, 0) = 1;  // the panel, and a hole in it
  const Retrace retrace = select({ItemSet(), ItemSet({kPanel})});
  EXPECT_THAT(retrace.items.pixels(), ElementsAre(0, 1, 0, 0));
}

TEST_F(SelectRetrace, TracesOnlyWhatIsDisputedOfItemsThatLookTheSameFromEverywhere) {
  const AnalyticRenderer matt{Panel::kMatt};
  holes = Mask(4, 1);
  disputed(1, 0) = 1;
  ItemVerdict verdict;
  verdict.disputes = Disputes::kOfAllItems;
  const Retrace retrace = selectOf(matt, verdict);
  EXPECT_THAT(retrace.items.pixels(), ElementsAre(0, 1, 0, 0));
}

TEST_F(SelectRetrace, LeavesWhatIsDisputedOfSuchItemsWhereItDoesNotCount) {
  const AnalyticRenderer matt{Panel::kMatt};
  holes = Mask(4, 1);
  disputed(1, 0) = 1;
  const Retrace retrace = selectOf(matt, {});
  EXPECT_THAT(retrace.items.pixels(), ElementsAre(0, 0, 0, 0));
}

class TrustIn : public testing::Test {
 protected:
  TrustIn() : item(3, 1, kWall) {
    item(1, 0) = kPanel;
    item(2, 0) = kNoItem;
  }
  ItemBuffer item;
  AnalyticRenderer mirror{Panel::kMirrorLike};
  AnalyticRenderer matt{Panel::kMatt};
};

TEST_F(TrustIn, OneSourceIsEnoughOfWhatLooksTheSameFromEverywhere) {
  ItemVerdict steady;
  steady.proven = steady.steady = ItemSet({kPanel});
  EXPECT_THAT(trustIn(item, {}, mirror).looksTheSame.pixels(), ElementsAre(1, 0, 1));
  EXPECT_THAT(trustIn(item, {}, matt).looksTheSame.pixels(), ElementsAre(1, 1, 1));
  EXPECT_THAT(trustIn(item, steady, mirror).looksTheSame.pixels(), ElementsAre(1, 1, 1));
}

TEST_F(TrustIn, IsLostByFailingItemsAndByViewDependentOnesThatWereNeverCompared) {
  const auto untrusted = [&](const ItemVerdict& verdict, const Renderer& renderer) {
    return trustIn(item, verdict, renderer).tracedWhole.items();
  };
  EXPECT_THAT(untrusted({}, mirror), ElementsAre(kPanel));
  EXPECT_THAT(untrusted({ItemSet(), ItemSet({kPanel})}, mirror), IsEmpty());
  EXPECT_THAT(untrusted({ItemSet({kWall}), ItemSet({kPanel})}, mirror), ElementsAre(kWall));
  EXPECT_THAT(untrusted({}, matt), IsEmpty());
  EXPECT_THAT(trustIn(item, {}, mirror).untrusted.pixels(), ElementsAre(0, 1, 0));
}

}  // namespace
}  // namespace promenade::walkthrough
