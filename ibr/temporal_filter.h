#pragma once
// The motion-compensated filter: the pixels of a frame from its own samples and those of the frames around
// it, each where the motion of the camera puts it. Sources: Myszkowski, Rokita, Tawara 2000, section 3
// (filtering along the pixel flow); Yang, Nehab, Sander, Sitthi-amorn, Marschner, Lawrence, Amortized
// supersampling (2009). What is done otherwise, and why: docs/method.md.

#include <span>

#include "ibr/crease.h"
#include "src/core/frame.h"

namespace promenade::ibr {

/// Standard deviation of the window in time of each display pixel, frames, > 0; +inf: all frames count alike.
using WindowMap = Map<struct WindowTag, float>;

/// Another frame of the walk.
struct NearbyFrame {
  const Frame* frame = nullptr;
  int framesAway = 0;  ///< != 0; either sign
};

struct TemporalFilterSettings {
  /// Samples of another frame count only where each covers at most this many samples of the filtered one, as
  /// in WarpSettings. > 0.
  double footprintLimit = 2.5;
  double creaseDegrees = kCreaseDegrees;
  /// What a surface reflects slides over it when the camera moves. From where a reflection of something
  /// infinitely far would slide by this many samples, the view-dependent layer of the other frame is not
  /// used. > 0.
  double slideLimit = 0.25;
};

/// The radiance of the display pixels of `frame`, `supersample`^2 samples each: the mean over the square of
/// the pixel, as resolveRadiance() has it of the frame's own samples, of all samples that fall into it.
/// Frames may have any sub-pixel offsets; that of `frame` itself is taken out, as far as a box takes it out.
/// Frames and the window must fit together in size; InputError.
[[nodiscard]] RadianceMap temporalFilter(const Frame& frame, int supersample,
                                         std::span<const NearbyFrame> others, const WindowMap& window,
                                         const TemporalFilterSettings& settings);

}  // namespace promenade::ibr
