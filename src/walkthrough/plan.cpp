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

Plan subdivide(FrameRange range, int spacing, const Judge& judge, const Accepted& accepted) {
  assert(range.last >= range.first && spacing >= 1);
  Plan plan;
  if (range.count() == 1) {
    divide({range.first, range.last, 0}, judge, accepted, plan);
    return plan;
  }
  for (int first = range.first; first < range.last; first += spacing) {
    divide({first, std::min(first + spacing, range.last), 0}, judge, accepted, plan);
  }
  return plan;
}

}  // namespace promenade::walkthrough
