#pragma once
// Depth-correct blending of two warped sources, and the holes that are left.

#include "ibr/warp.h"

namespace promenade::ibr {

struct Blended {
  Frame frame;  ///< visibility is the target's; `source` says warped, blended; holes have radiance 0
  Mask holes;   ///< no valid source: to be ray traced
};

/// `t` in [0, 1]: 0 at the frame of `previous`, 1 at that of `next`. Where both are valid the weights are
/// (1 - t) and t times sampling quality (the finer footprint counts more; it falls to 0 as the footprint
/// nears its limit, so that no weight jumps when the sample stops being valid), continuous in t, exactly 1
/// and 0 at the ends: there the result is the warped keyframe bit for bit. Where the two disagree in depth by
/// more than the tolerance (half a sample of the target across the line of sight) the nearer one wins. Throws
/// InputError if the maps differ in size or t is outside [0, 1].
[[nodiscard]] Blended blend(const Warped& previous, const Warped& next, Visibility target, double t);

/// Fills holes that are still open from one more source, e.g. the ray-traced samples of an inbetween that was
/// finished before. `source` says which (kWarpedFromPrevious or kWarpedFromNext). Samples that are no holes
/// stay as they are.
[[nodiscard]] Blended fillHoles(Blended blended, const Warped& more, SampleSource source);

}  // namespace promenade::ibr
