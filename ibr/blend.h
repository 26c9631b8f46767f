#pragma once
// Depth-correct blending of two warped sources, and the holes that are left.

#include "ibr/warp.h"

namespace promenade::ibr {

struct Blended {
  Frame frame;  ///< visibility is the target's; `source` says warped, blended; holes have radiance 0
  Mask holes;   ///< no valid source: to be ray traced
};

/// `t` in [0, 1]: 0 at the frame of `previous`, 1 at that of `next`. Where both are valid the weights are
/// (1 - t) and t times sampling quality (the finer footprint counts more), continuous in t, exactly 1 and 0 at the ends.
/// Where the two disagree in depth beyond the tolerance the nearer one wins.
[[nodiscard]] Blended blend(const Warped& previous, const Warped& next, Visibility target, double t);

}  // namespace promenade::ibr
