#include "src/walkthrough/statistics.h"

#include <algorithm>

namespace promenade::walkthrough {

void Statistics::append(const Statistics& more) {
  frames.insert(frames.end(), more.frames.begin(), more.frames.end());
  segments.insert(segments.end(), more.segments.begin(), more.segments.end());
  seconds.trace += more.seconds.trace;
  seconds.visibility += more.seconds.visibility;
  seconds.warp += more.seconds.warp;
  seconds.metric += more.seconds.metric;
  seconds.filter += more.seconds.filter;
  seconds.output += more.seconds.output;
}

RayCounts Statistics::rays() const {
  RayCounts sum;
  for (const FrameStatistics& frame : frames) sum += frame.rays;
  for (const SegmentStatistics& segment : segments) sum += segment.rays;
  return sum;
}

std::uint64_t Statistics::samples() const {
  std::uint64_t sum = 0;
  for (const FrameStatistics& frame : frames) sum += frame.samples;
  return sum;
}

std::uint64_t Statistics::samplesTraced() const {
  std::uint64_t sum = 0;
  for (const FrameStatistics& frame : frames) sum += frame.samplesTraced;
  return sum + probes();
}

std::uint64_t Statistics::probes() const {
  std::uint64_t sum = 0;
  for (const SegmentStatistics& segment : segments) sum += segment.probes;
  return sum;
}

std::uint64_t Statistics::disputed() const {
  std::uint64_t sum = 0;
  for (const FrameStatistics& frame : frames) sum += frame.disputed;
  return sum;
}

int Statistics::keyframes() const {
  return static_cast<int>(std::count_if(frames.begin(), frames.end(), [](const FrameStatistics& frame) {
    return frame.kind == FrameKind::kKeyframe;
  }));
}

double Statistics::tracedFraction() const {
  const auto all = samples();
  return all == 0 ? 0.0 : static_cast<double>(samplesTraced()) / static_cast<double>(all);
}

}  // namespace promenade::walkthrough
