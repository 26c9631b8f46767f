#pragma once
// Pixel flow: exact, from depth and two cameras.

#include "src/core/frame.h"

namespace promenade::ibr {

/// Displacement, in pixels of `from`, of the scene point seen at each pixel of `from` when the camera becomes
/// `to` (same resolution). Background flows as a point at infinity. NaN where the point is behind the eye of `to`.
[[nodiscard]] PixelFlow pixelFlow(const Visibility& from, const Camera& to);

/// Velocity for the metric, degrees per second: the mean of the magnitudes of the displacements since the previous and to the following frame,
/// in the direction of their mean vector ((next - previous) / 2 with both measured from this frame), times frame rate over pixels per degree.
/// Where one flow is not valid the other stands alone; where neither is, 0. Either map may be empty (first or last frame).
[[nodiscard]] VelocityMap imageVelocity(const PixelFlow& toPrevious, const PixelFlow& toNext, double framesPerSecond,
                                        double pixelsPerDegree);

}  // namespace promenade::ibr
