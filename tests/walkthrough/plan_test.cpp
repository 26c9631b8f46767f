#include "src/walkthrough/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

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
  for (const Segment& first : equalSegments(range, spacing)) {
    const Plan more = subdivide(first, judge, accepted);
    plan.insert(plan.end(), more.begin(), more.end());
  }
  return plan;
}

TEST(Plan, KeepsFirstSegmentsThatAreAccepted) {
  // 40 frames in three parts of 13 1/3.
  EXPECT_THAT(planOf({0, 40}, 16, always(Decision::kAccept)),
              ElementsAre(Segment{0, 13, 0}, Segment{13, 26, 0}, Segment{26, 40, 0}));
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

/// Of a segment: no two are alike.
std::int64_t pseudorandomCost(int first, int last) {
  return (first * 7919 + last * 104729) % 1009 + 10;
}

/// Of all divisions of (first, last) into segments of at most `longest`.
std::int64_t cheapest(int first, int last, int longest) {
  if (first == last) return 0;
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  for (int next = first + 1; next <= std::min(first + longest, last); ++next) {
    least = std::min(least, pseudorandomCost(first, next) + cheapest(next, last, longest));
  }
  return least;
}

SegmentCosts pseudorandomCosts(int longest) {
  return [longest](int first) {
    std::vector<std::int64_t> costs;
    for (int k = 1; k <= longest; ++k) costs.push_back(pseudorandomCost(first, first + k));
    return costs;
  };
}

TEST(CheapestSegments, CostLeastOfAllDivisions) {
  for (int last = 1; last <= 12; ++last) {
    for (int longest = 1; longest <= 12; ++longest) {
      const Plan plan = cheapestSegments({3, 3 + last}, pseudorandomCosts(longest));
      std::int64_t cost = 0;
      int end = 3;
      for (const Segment& segment : plan) {
        EXPECT_EQ(segment.first, end);
        EXPECT_LE(segment.last - segment.first, longest);
        cost += pseudorandomCost(segment.first, segment.last);
        end = segment.last;
      }
      EXPECT_EQ(end, 3 + last);
      EXPECT_EQ(cost, cheapest(3, 3 + last, longest)) << last << ", " << longest;
    }
  }
}

TEST(CheapestSegments, AreOfEqualLengthWhereAllCostTheSame) {
  // Of 3, 3 and 2 frames in some order, with the least sum of squares.
  const Plan plan = cheapestSegments({0, 8}, [](int) { return std::vector<std::int64_t>(3, 1); });
  ASSERT_EQ(plan.size(), 3u);
  int squares = 0;
  for (const Segment& segment : plan)
    squares += (segment.last - segment.first) * (segment.last - segment.first);
  EXPECT_EQ(squares, 9 + 9 + 4);
}

TEST(CheapestSegments, OfOneFrameAreOneAndAskNothing) {
  const auto unasked = [](int) -> std::vector<std::int64_t> { throw std::logic_error("asked"); };
  EXPECT_THAT(cheapestSegments({5, 5}, unasked), ElementsAre(Segment{5, 5, 0}));
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
