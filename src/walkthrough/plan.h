#pragma once
// Which frames are ray traced whole. The rule knows nothing of rendering: it asks a judge.
// Source: Myszkowski, Rokita, Tawara 2000, section 4 (adaptive subdivision of segments).

#include <cstdint>
#include <functional>
#include <vector>

namespace promenade::walkthrough {

/// Inclusive frame numbers.
struct FrameRange {
  int first = 0;
  int last = 0;
  [[nodiscard]] int count() const { return last - first + 1; }
};

/// Neighbouring keyframes and the inbetweens between them. first == last only for an animation of one frame.
struct Segment {
  int first = 0;  ///< a keyframe
  int last = 0;   ///< a keyframe
  int depth = 0;  ///< how often a first segment was split to get here
  [[nodiscard]] int middle() const { return first + (last - first) / 2; }
  [[nodiscard]] bool hasInbetweens() const { return last - first > 1; }
  friend bool operator==(const Segment&, const Segment&) = default;
};

/// Sorted and gap-free: each segment begins with the keyframe that ends the one before it.
using Plan = std::vector<Segment>;

enum class Decision { kAccept, kSplit };

/// Asked once for every segment that has inbetweens.
using Judge = std::function<Decision(const Segment&)>;
/// Told of every accepted segment, in the order of time, as soon as it is accepted and before anything later
/// is judged.
using Accepted = std::function<void(const Segment&)>;

/// `range` in as few first segments of at most `longest` frames as there can be, of equal length to a frame.
/// Preconditions (asserted): range is not empty, longest >= 1.
[[nodiscard]] Plan equalSegments(FrameRange range, int longest);

/// What the segments cost that begin with frame `first`: entry k that of (first, first + 1 + k), >= 0. As
/// many as there are.
using SegmentCosts = std::function<std::vector<std::int64_t>(int first)>;

/// The division of `range` into first segments that costs least in all (a shortest path: Bellman 1958). Of
/// several such, one whose lengths have the least sum of squares. `costsFrom` is asked once for every frame
/// of the range but the last, in the order of time; what it gives beyond the range does not count.
/// Preconditions (asserted): range is not empty, and no answer is.
[[nodiscard]] Plan cheapestSegments(FrameRange range, const SegmentCosts& costsFrom);

/// Splits a first segment in the middle for as long as the judge says so, down to neighbouring frames.
Plan subdivide(const Segment& first, const Judge& judge, const Accepted& accepted);

}  // namespace promenade::walkthrough
