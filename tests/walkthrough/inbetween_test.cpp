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
  AnalyticRenderer renderer{Panel::kMirrorLike};
  ItemBuffer item;
  Mask holes;
  SourceMap source;
  Mask disputed{4, 1};
};

TEST_F(SelectRetrace, TracesHolesAndFailingItemsOnce) {
  const Retrace retrace =
      selectRetrace(item, holes, source, disputed, {ItemSet({kPanel}), ItemSet()}, renderer);
  EXPECT_THAT(retrace.holes.pixels(), ElementsAre(0, 0, 1, 1));
  EXPECT_THAT(retrace.items.pixels(), ElementsAre(0, 1, 0, 0));
  EXPECT_THAT(retrace.traced.items(), ElementsAre(kPanel));
}

TEST_F(SelectRetrace, TracesViewDependentItemsThatWereNeverCompared) {
  const Retrace retrace = selectRetrace(item, holes, source, disputed, {}, renderer);
  EXPECT_THAT(retrace.items.pixels(), ElementsAre(0, 1, 0, 0));
}

TEST_F(SelectRetrace, WarpsItemsThatWereProven) {
  const Retrace retrace =
      selectRetrace(item, holes, source, disputed, {ItemSet(), ItemSet({kPanel})}, renderer);
  EXPECT_THAT(retrace.items.pixels(), ElementsAre(0, 0, 0, 0));
  EXPECT_THAT(retrace.traced.items(), IsEmpty());
}

TEST_F(SelectRetrace, TracesWhatOfAProvenItemOneKeyframeAloneFills) {
  source(0, 0) = source(1, 0) = SampleSource::kWarpedFromNext;  // the wall and the panel
  const Retrace retrace =
      selectRetrace(item, holes, source, disputed, {ItemSet(), ItemSet({kPanel})}, renderer);
  EXPECT_THAT(retrace.items.pixels(), ElementsAre(0, 1, 0, 0));
  EXPECT_THAT(retrace.traced.items(), IsEmpty());
}

TEST_F(SelectRetrace, WarpsWhatOfASteadyItemOneKeyframeAloneFillsButNotWhatIsDisputed) {
  source = SourceMap(4, 1, SampleSource::kWarpedFromNext);
  holes = Mask(4, 1);
  disputed(2, 0) = 1;
  ItemVerdict verdict;
  verdict.proven = verdict.steady = ItemSet({kPanel});
  const Retrace retrace = selectRetrace(item, holes, source, disputed, verdict, renderer);
  EXPECT_THAT(retrace.items.pixels(), ElementsAre(0, 0, 1, 0));
  EXPECT_THAT(retrace.traced.items(), IsEmpty());
}

TEST_F(SelectRetrace, TracesWhatOfAProvenItemTheKeyframesContradictEachOtherIn) {
  disputed(1, 0) = disputed(2, 0) = 1;  // the panel, and a hole in it
  const Retrace retrace =
      selectRetrace(item, holes, source, disputed, {ItemSet(), ItemSet({kPanel})}, renderer);
  EXPECT_THAT(retrace.items.pixels(), ElementsAre(0, 1, 0, 0));
  EXPECT_THAT(retrace.traced.items(), IsEmpty());
}

TEST_F(SelectRetrace, TracesOnlyWhatIsDisputedOfItemsThatLookTheSameFromEverywhere) {
  const AnalyticRenderer matt{Panel::kMatt};
  disputed(1, 0) = 1;
  ItemVerdict verdict;
  verdict.disputes = Disputes::kOfAllItems;
  const Retrace retrace = selectRetrace(item, Mask(4, 1), source, disputed, verdict, matt);
  EXPECT_THAT(retrace.items.pixels(), ElementsAre(0, 1, 0, 0));
  EXPECT_THAT(retrace.traced.items(), IsEmpty());
}

TEST_F(SelectRetrace, LeavesWhatIsDisputedOfSuchItemsWhereItDoesNotCount) {
  const AnalyticRenderer matt{Panel::kMatt};
  disputed(1, 0) = 1;
  const Retrace retrace = selectRetrace(item, Mask(4, 1), source, disputed, {}, matt);
  EXPECT_THAT(retrace.items.pixels(), ElementsAre(0, 0, 0, 0));
}

TEST(SharedAmongInbetweens, IsWhatLooksTheSameFromEverywhere) {
  ItemBuffer item(3, 1, kWall);
  item(1, 0) = kPanel;
  item(2, 0) = kNoItem;
  const AnalyticRenderer mirror{Panel::kMirrorLike};
  const AnalyticRenderer matt{Panel::kMatt};
  ItemVerdict steady;
  steady.proven = steady.steady = ItemSet({kPanel});
  EXPECT_THAT(sharedAmongInbetweens(item, {}, mirror).pixels(), ElementsAre(1, 0, 1));
  EXPECT_THAT(sharedAmongInbetweens(item, {}, matt).pixels(), ElementsAre(1, 1, 1));
  EXPECT_THAT(sharedAmongInbetweens(item, steady, mirror).pixels(), ElementsAre(1, 1, 1));
}

}  // namespace
}  // namespace promenade::walkthrough
