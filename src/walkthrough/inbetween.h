#pragma once
// One inbetween: warped from the two keyframes of its segment, blended, and what is left traced.

#include "src/walkthrough/judge.h"

namespace promenade::walkthrough {

/// What of an inbetween is ray traced.
struct Retrace {
  Mask holes;  ///< no keyframe fills the sample
  Mask items;  ///< the sample belongs to an item whose warped look a viewer could tell; disjoint from holes
  ItemSet traced;
};

/// A view-dependent item is traced unless the middle of the segment proved that its warped look passes:
/// failing items, and items that could not be compared there. What of a proven item only one keyframe fills
/// (`source`) is traced as well: the proof is for what both agree on.
[[nodiscard]] Retrace selectRetrace(const ItemBuffer& item, const Mask& holes, const SourceMap& source,
                                    const ItemVerdict& verdict, const Renderer& renderer);

struct Inbetween {
  Frame frame;
  FrameStatistics statistics;  ///< without seconds
};

/// `t` in (0, 1): the place of the frame between its keyframes. `seconds` is the running account of the whole
/// walk.
[[nodiscard]] Inbetween synthesise(WarpedPair&& warped, double t, int frameIndex, const ItemVerdict& verdict,
                                   const Renderer& renderer, PartSeconds& seconds);

}  // namespace promenade::walkthrough
