#include "src/walkthrough/plan.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <tuple>

namespace promenade::walkthrough {
namespace {

void divide(const Segment& segment, const Judge& judge, const Accepted& accepted, Plan& plan) {
  if (segment.hasInbetweens() && judge(segment) == Decision::kSplit) {
    divide({segment.first, segment.middle(), segment.depth + 1}, judge, accepted, plan);
    divide({segment.middle(), segment.last, segment.depth + 1}, judge, accepted, plan);
    return;
  }
  accepted(segment);
  plan.push_back(segment);
}

}  // namespace

Plan equalSegments(FrameRange range, int longest) {
  assert(range.last >= range.first && longest >= 1);
  if (range.count() == 1) return {{range.first, range.last, 0}};
  const int frames = range.last - range.first;
  const int count = (frames - 1) / longest + 1;
  // The k-th border; the product may be large.
  const auto border = [&](int k) {
    return range.first + static_cast<int>(static_cast<std::int64_t>(frames) * k / count);
  };
  Plan segments;
  for (int k = 0; k < count; ++k) segments.push_back({border(k), border(k + 1), 0});
  return segments;
}

Plan cheapestSegments(FrameRange range, const SegmentCosts& costsFrom) {
  assert(range.last >= range.first);
  if (range.count() == 1) return {{range.first, range.last, 0}};
  // The cheapest way to have a keyframe at each frame: its price, and the keyframe before it.
  struct Way {
    std::int64_t cost = std::numeric_limits<std::int64_t>::max();
    std::int64_t squaredLengths = 0;
    int before = 0;
  };
  std::vector<Way> ways(static_cast<std::size_t>(range.count()));
  const auto wayTo = [&](int frame) -> Way& { return ways[static_cast<std::size_t>(frame - range.first)]; };
  wayTo(range.first).cost = 0;
  for (int first = range.first; first < range.last; ++first) {
    const Way so = wayTo(first);
    const std::vector<std::int64_t> costs = costsFrom(first);
    assert(!costs.empty());
    for (std::size_t k = 0; k < costs.size(); ++k) {
      const auto length = static_cast<std::int64_t>(k) + 1;
      if (first + length > range.last) break;
      const Way way{so.cost + costs[k], so.squaredLengths + length * length, first};
      Way& best = wayTo(first + static_cast<int>(length));
      if (std::tie(way.cost, way.squaredLengths) < std::tie(best.cost, best.squaredLengths)) best = way;
    }
  }
  Plan segments;
  for (int last = range.last; last > range.first; last = segments.back().first) {
    segments.push_back({wayTo(last).before, last, 0});
  }
  std::reverse(segments.begin(), segments.end());
  return segments;
}

Plan subdivide(const Segment& first, const Judge& judge, const Accepted& accepted) {
  Plan plan;
  divide(first, judge, accepted, plan);
  return plan;
}

}  // namespace promenade::walkthrough
