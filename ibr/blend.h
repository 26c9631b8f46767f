#pragma once
// Depth-correct blending of warped sources, and the holes that are left.

#include <span>
#include <variant>

#include "ibr/warp.h"

namespace promenade::ibr {

struct Blended {
  Frame frame;  ///< visibility is the target's; `source` says warped, blended, or kUnknown, with radiance 0
  Mask holes;   ///< no valid source: to be ray traced
  /// Where only earlier or only later sources count: |ln(cos / cos')|, cos and cos' between the normal and
  /// the lines of sight from the target and from a source, the mean of the sources as they count. By as much
  /// changes the logarithm of a reflection that goes by 1/cos, as microfacets do but for their shadowing
  /// (Walter et al. 2007, eq. 20). Elsewhere 0.
  Map<struct SlantTag, float> slantChange;
  /// Likewise: the radians between those lines of sight. By as much turns what is mirrored.
  Map<struct TurnTag, float> turn;
};

/// A frame warped to the target, as maps or sample by sample, and when its samples were ray traced, in any
/// unit of time.
struct BlendSource {
  std::variant<const Warped*, const SampleGather*> warped;
  double time = 0.0;
};

/// What the target sees at `time`. Where a source is valid it counts with its sampling quality (the finer
/// footprint counts more; it falls to 0 as the footprint nears its limit, so that no weight jumps when the
/// sample stops being valid) over its distance in time: inverse distance weighting (Shepard 1968), which for
/// two sources is the linear weight of both. Weights are continuous in time, and at the time of a source
/// exactly 1 for it where it is valid: there the result is that source bit for bit. Sources behind the
/// nearest surface that a valid source shows, by more than the tolerance (half a sample of the target across
/// the line of sight), do not count. `source` of the result: kWarpedFromPrevious or kWarpedFromNext where
/// only earlier or only later sources count, else kBlended. Where no source is valid, but some are
/// undersampled, the hole has what these show, weighted by 1/footprint over distance in time: blurred, for
/// those who cannot trace it. Throws InputError if there is no source, if the maps differ in size, or if
/// times do not increase or `time` is not between the first and the last of them.
/// `target` may be what a source refers to: it becomes part of the result when all is blended.
[[nodiscard]] Blended blend(std::span<const BlendSource> sources, Visibility&& target, double time);

/// The same for two keyframes: `t` in [0, 1], 0 at the frame of `previous`, 1 at that of `next`.
[[nodiscard]] Blended blend(const Warped& previous, const Warped& next, Visibility target, double t);

}  // namespace promenade::ibr
