#pragma once
// Which frames are ray traced whole. The rule knows nothing of rendering: it asks a judge.
// Source: Myszkowski, Rokita, Tawara 2000, section 4 (adaptive subdivision of segments).

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

/// `range` in first segments of `spacing` frames (the last may be shorter). They need nothing from each other
/// but the keyframes they share. Preconditions (asserted): range is not empty, spacing >= 1.
[[nodiscard]] Plan firstSegments(FrameRange range, int spacing);

/// Splits a first segment in the middle for as long as the judge says so, down to neighbouring frames.
Plan subdivide(const Segment& first, const Judge& judge, const Accepted& accepted);

}  // namespace promenade::walkthrough
