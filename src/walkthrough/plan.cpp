#include "src/walkthrough/plan.h"

#include <algorithm>
#include <cassert>

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

Plan firstSegments(FrameRange range, int spacing) {
  assert(range.last >= range.first && spacing >= 1);
  if (range.count() == 1) return {{range.first, range.last, 0}};
  Plan segments;
  for (int first = range.first; first < range.last; first += spacing) {
    segments.push_back({first, std::min(first + spacing, range.last), 0});
  }
  return segments;
}

Plan subdivide(const Segment& first, const Judge& judge, const Accepted& accepted) {
  Plan plan;
  divide(first, judge, accepted, plan);
  return plan;
}

}  // namespace promenade::walkthrough
