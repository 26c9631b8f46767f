#include "src/walkthrough/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace promenade::walkthrough {
namespace {

using testing::ElementsAre;

Judge always(Decision decision) {
  return [decision](const Segment&) { return decision; };
}
const Accepted kIgnore = [](const Segment&) {};

// All of a walk.
Plan planOf(FrameRange range, int spacing, const Judge& judge, const Accepted& accepted = kIgnore) {
  Plan plan;
  for (const Segment& first : firstSegments(range, spacing)) {
    const Plan more = subdivide(first, judge, accepted);
    plan.insert(plan.end(), more.begin(), more.end());
  }
  return plan;
}

TEST(Plan, KeepsFirstSegmentsThatAreAccepted) {
  // 0..40 in steps of 16: 0-16, 16-32, and what is left, 32-40.
  EXPECT_THAT(planOf({0, 40}, 16, always(Decision::kAccept)),
              ElementsAre(Segment{0, 16, 0}, Segment{16, 32, 0}, Segment{32, 40, 0}));
}

TEST(Plan, SplitsDownToNeighbouringFrames) {
  EXPECT_THAT(planOf({3, 7}, 16, always(Decision::kSplit)),
              ElementsAre(Segment{3, 4, 2}, Segment{4, 5, 2}, Segment{5, 6, 2}, Segment{6, 7, 2}));
}

TEST(Plan, PutsTheMiddleOfAnOddSegmentOnAWholeFrame) {
  // 0..5: the middle is (0 + 5) / 2 = 2 (rounded down), then 2..5 has its middle at 3.
  EXPECT_THAT(
      planOf({0, 5}, 5, always(Decision::kSplit)),
      ElementsAre(Segment{0, 1, 2}, Segment{1, 2, 2}, Segment{2, 3, 2}, Segment{3, 4, 3}, Segment{4, 5, 3}));
}

TEST(Plan, SplitsOnlyWhereTheJudgeSaysSo) {
  const Judge splitAroundTen = [](const Segment& s) {
    return s.first <= 10 && 10 < s.last && s.last - s.first > 4 ? Decision::kSplit : Decision::kAccept;
  };
  EXPECT_THAT(planOf({0, 32}, 16, splitAroundTen),
              ElementsAre(Segment{0, 8, 1}, Segment{8, 12, 2}, Segment{12, 16, 2}, Segment{16, 32, 0}));
}

TEST(Plan, NeverAsksAboutASegmentWithoutInbetweens) {
  int asked = 0;
  const Judge counting = [&asked](const Segment& s) {
    EXPECT_TRUE(s.hasInbetweens());
    ++asked;
    return Decision::kSplit;
  };
  // Four frames apart: 0-4 is asked, 0-2 and 2-4 are asked; pairs of neighbours are not.
  (void)planOf({0, 4}, 4, counting);
  EXPECT_EQ(asked, 3);
}

TEST(Plan, ReportsSegmentsInTheOrderOfTimeBeforeItJudgesLaterOnes) {
  std::vector<int> events;
  const Judge judge = [&events](const Segment& s) {
    events.push_back(s.first);
    return Decision::kAccept;
  };
  const Accepted accepted = [&events](const Segment& s) { events.push_back(-s.last); };
  (void)planOf({0, 20}, 10, judge, accepted);
  EXPECT_THAT(events, ElementsAre(0, -10, 10, -20));
}

TEST(Plan, OfOneFrameIsOneSegmentWithoutInbetweens) {
  EXPECT_THAT(planOf({5, 5}, 16, always(Decision::kSplit)), ElementsAre(Segment{5, 5, 0}));
}

TEST(Plan, IsGapFreeForEveryLengthAndSpacing) {
  for (int last = 1; last < 40; ++last) {
    for (int spacing = 1; spacing < 20; ++spacing) {
      const Judge pseudorandom = [](const Segment& s) {
        return (s.first * 7 + s.last * 13) % 3 == 0 ? Decision::kSplit : Decision::kAccept;
      };
      const Plan plan = planOf({0, last}, spacing, pseudorandom);
      int end = 0;
      for (const Segment& segment : plan) {
        EXPECT_EQ(segment.first, end);
        EXPECT_GT(segment.last, segment.first);
        end = segment.last;
      }
      EXPECT_EQ(end, last);
    }
  }
}

}  // namespace
}  // namespace promenade::walkthrough
