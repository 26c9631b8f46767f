#pragma once
// The animation quality metric: where, and how surely, a viewer sees a difference between two frames.
// Sources: Daly 1993 (VDP), Daly 1998 (spatiovelocity CSF), Kelly 1979, Watson 1987 (cortex transform),
// Eriksson et al. 1998 (masking, pooling), Myszkowski, Rokita, Tawara 1999, 2000 (AQM). docs/method.md has
// the maths.

#include "aqm/settings.h"
#include "src/core/image.h"

namespace promenade::aqm {

/// A detection probability in [-1, 1], negative where the test frame looks darker than the reference.
using SignedProbabilityMap = Map<struct SignedProbabilityTag, float>;

struct Result {
  JndMap jnd;                  ///< J: sharp map; see where, not whether: about 2 at threshold if pooled
  JndMap pooledJnd;            ///< Jp: pooled over half a degree; 1 at threshold. J without pooling
  ProbabilityMap probability;  ///< P = 1 - exp(-Jp^3.5)
  SignedProbabilityMap signedProbability;  ///< P with the sign of the change; empty unless asked for
};

/// Compares two frames of the same size, luminance in cd/m2 (> 0). `velocity` (the same size, or empty for a
/// static scene) is the image velocity in degrees per second. Symmetric unless one of the frames is the mask:
/// swapping the frames then changes no bit (but the sign of the signed map). Equal frames give exactly 0.
/// Throws InputError for a size mismatch, an empty frame, settings out of range, and for a luminance or a
/// velocity that is not finite or a luminance <= 0 (the message names the pixel).
[[nodiscard]] Result compare(const LuminanceMap& test, const LuminanceMap& reference,
                             const VelocityMap& velocity, const Settings& settings);

/// A viewer is counted as seeing a difference at a pixel above this probability.
inline constexpr float kVisibleProbability = 0.75f;

/// Per cent of pixels with P > 0.75, of those that `excluded` (same size, or empty: none) does not select;
/// 0 if all are excluded.
[[nodiscard]] double percentVisible(const ProbabilityMap& probability, const Mask& excluded);

}  // namespace promenade::aqm
