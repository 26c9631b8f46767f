#pragma once
// Two warps can agree and both be wrong: a highlight that comes back to where it was, what one keyframe alone
// shows, a surface seen at a grazing angle from both ends. So a few samples of the middle are ray traced and
// held against its warp, as a viewer would see the difference.

#include <cstdint>

#include "src/walkthrough/judge.h"
#include "src/walkthrough/probes.h"

namespace promenade::walkthrough {

/// What is to be checked: the middle of a segment that the comparison of its two warps accepted.
struct Middle {
  int frameIndex = 0;
  double t = 0.5;  ///< its place between the keyframes, in (0, 1)
  const WarpedPair& warped;
  const VelocityMap& velocity;  ///< image velocity at display resolution
  const ItemVerdict& items;
};

/// 0 for samples that are ray traced anyway (`traced`), 4 where one keyframe alone shows the sample, or both
/// at more than 1.5 times its area, or the target itself at more than 78 degrees from the normal; else 1.
[[nodiscard]] ProbeWeights probeWeights(const WarpedPair& warped, const Mask& traced);

struct Verification {
  ItemVerdict items;               ///< items that the probes caught have moved from proven to failing
  std::uint64_t probes = 0;        ///< samples that were ray traced for it
  double differencePercent = 0.0;  ///< of the middle's remaining pixels: P > 0.75 between warp and probes
  Decision decision = Decision::kAccept;
};

/// Traces settings.probeShare of the middle's warped samples. Their contrast errors, spread to an image and
/// freed from noise (contrast_error.h), are laid over the blended middle, and the metric compares the two. A
/// view-dependent item of which more than the tolerance differs visibly fails; of what then remains the
/// decision is made as in judgeMiddle(). The traced samples are not used for anything else: one of them amid
/// warped ones would flicker.
[[nodiscard]] Verification verifyMiddle(const Middle& middle, const Renderer& renderer,
                                        const Settings& settings, PartSeconds& seconds);

}  // namespace promenade::walkthrough
