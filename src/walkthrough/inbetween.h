#pragma once
// One inbetween: warped from what was traced of its segment before (its two keyframes and samples of other
// inbetweens), blended, and what is left traced.

#include <vector>

#include "src/walkthrough/item_trust.h"
#include "src/walkthrough/judge.h"

namespace promenade::walkthrough {

/// What of an inbetween is ray traced.
struct Retrace {
  Mask holes;  ///< no source fills the sample as it looks from here
  Mask items;  ///< the sample belongs to an item whose warped look a viewer could tell; disjoint from holes
};

/// A view-dependent item is traced unless the middle of the segment proved that its warped look passes:
/// failing items, and items that could not be compared there. What of a proven item only one keyframe fills
/// (`source`) is traced as well, unless the item is steady: the proof is for what both agree on. So are those
/// of the `disputed` samples (disputedSamples()) that count by the verdict.
[[nodiscard]] Retrace selectRetrace(const Mask& holes, const SourceMap& source, const Mask& disputed,
                                    const ItemTrust& trust);

struct Inbetween {
  Frame frame;
  FrameStatistics statistics;  ///< without seconds
};

/// All that an inbetween is made of. Nothing in it that counts was warped itself.
struct InbetweenSources {
  WarpedPair keyframes;
  /// Of the segment, whose traced samples may serve here, of items that look the same. (Others are traced, or
  /// were proven as a blend of both keyframes.)
  std::vector<const Inbetween*> others;
};

/// Frame `frameIndex` of `segment`. What sources show at another slant only counts as a hole (slant.h).
/// `seconds` is the running account of the whole walk.
[[nodiscard]] Inbetween synthesise(InbetweenSources&& sources, const Segment& segment, int frameIndex,
                                   const ItemVerdict& verdict, const Renderer& renderer,
                                   const Settings& settings, PartSeconds& seconds);

}  // namespace promenade::walkthrough
