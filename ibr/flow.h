#pragma once
// Pixel flow: exact, from depth and two cameras.

#include "src/core/frame.h"

namespace promenade::ibr {

/// Displacement, in pixels of `from`, of the scene point seen at each pixel of `from` when the camera becomes
/// `to`. Background flows as a point at infinity. NaN where the point is behind the eye of `to` (or in the
/// plane of the eye, so that its image is infinitely far away). Precise to about 1e-7 focal lengths in
/// pixels; exactly 0 for equal cameras. Throws InputError unless `to` and the depth map have the resolution
/// of the camera of `from`.
[[nodiscard]] PixelFlow pixelFlow(const Visibility& from, const Camera& to);

/// Velocity for the metric, degrees per second: the mean of the magnitudes of the displacements since the
/// previous and to the following frame, in the direction of their mean vector ((next - previous) / 2 with
/// both measured from this frame; that of `next` where the mean vector is 0: the point turns back), times
/// frame rate over pixels per degree. Where one flow is not valid the other stands alone; where neither is,
/// 0. Either map may be empty (first or last frame); if both are, so is the result. Always finite. Throws
/// InputError for two sizes that differ, and for a frame rate or pixels per degree that is not positive.
[[nodiscard]] VelocityMap imageVelocity(const PixelFlow& toPrevious, const PixelFlow& toNext,
                                        double framesPerSecond, double pixelsPerDegree);

}  // namespace promenade::ibr
