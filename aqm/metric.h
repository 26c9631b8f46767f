#pragma once
// The animation quality metric: where, and how surely, a viewer sees a difference between two frames.
// Sources: Daly 1993 (VDP), Daly 1998 (spatiovelocity CSF), Kelly 1979, Watson 1987 (cortex transform),
// Eriksson et al. 1998 (masking, pooling), Myszkowski, Rokita, Tawara 1999, 2000 (AQM). docs/method.md has
// the maths.

#include "src/core/image.h"

namespace promenade::aqm {

/// Far finer than the eye resolves (60 cycles per degree); finer still would only cost memory.
inline constexpr double kMostPixelsPerDegree = 2000.0;

struct Settings {
  double pixelsPerDegree = 40.0;  ///< of the display, > 0, <= kMostPixelsPerDegree
};

struct Result {
  JndMap jnd;                  ///< J: sharp map, about 2 at threshold; see where, not whether
  JndMap pooledJnd;            ///< Jp: pooled over half a degree; 1 at threshold
  ProbabilityMap probability;  ///< P = 1 - exp(-Jp^3.5)
};

/// Compares two frames of the same size, luminance in cd/m2 (> 0). `velocity` (the same size, or empty for a
/// static scene) is the image velocity in degrees per second. Symmetric: swapping the frames changes no bit.
/// Equal frames give exactly 0. Throws InputError for a size mismatch, an empty frame, pixels per degree out
/// of range, and for a luminance or a velocity that is not finite or a luminance <= 0 (the message names the
/// pixel).
[[nodiscard]] Result compare(const LuminanceMap& test, const LuminanceMap& reference,
                             const VelocityMap& velocity, const Settings& settings);

/// A viewer is counted as seeing a difference at a pixel above this probability.
inline constexpr float kVisibleProbability = 0.75f;

/// Per cent of pixels with P > 0.75, of those that `excluded` (same size, or empty: none) does not select;
/// 0 if all are excluded.
[[nodiscard]] double percentVisible(const ProbabilityMap& probability, const Mask& excluded);

}  // namespace promenade::aqm
