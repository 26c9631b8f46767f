#pragma once
// 3D warping of ray-traced samples to another view. Two methods, one result: gatherWarp (needs the target's
// visibility) and, for frames that another renderer made, a forward warp can stand beside it.
// Sources: McMillan 1997; Mark, McMillan, Bishop 1997; Nehab et al. 2007 (reverse reprojection).

#include <cstdint>

#include "src/core/frame.h"

namespace promenade::ibr {

enum class Validity : std::uint8_t {
  kValid = 0,
  kOutside,       ///< the source does not cover this direction
  kOccluded,      ///< the source sees another surface there
  kUndersampled,  ///< the source sampled the surface too coarsely (footprint above the limit)
};
using ValidityMap = Map<struct ValidityTag, Validity>;

/// Source samples as seen from the target, at the target's sample resolution.
struct Warped {
  RadianceMap diffuse;
  RadianceMap viewDependent;
  DepthMap depth;                                              ///< of the target surface
  ItemBuffer item;                                             ///< of the target surface
  ValidityMap validity;                                        ///< radiance is meaningful only where kValid
  Map<struct SourcePositionTag, glm::vec2> sourcePosition;     ///< pixels in the source
  Map<struct FootprintTag, float> footprint;                   ///< surface area of a source sample over that of the target sample
};

struct WarpSettings {
  /// A target sample is valid only if the source sample's area on the surface is at most this many times its own.
  double footprintLimit = 2.5;
};

/// Fetches each target sample from `source` (ray-traced samples only: a warped sample is never a source).
/// `target` is the exact visibility of the target camera.
[[nodiscard]] Warped gatherWarp(const Frame& source, const Visibility& target, const WarpSettings& settings);

}  // namespace promenade::ibr
