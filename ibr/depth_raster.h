#pragma once
// A z-buffer for patches.

#include "ibr/surface_patches.h"
#include "src/core/frame.h"

namespace promenade::ibr {

/// What a frame's surfaces look like from another camera.
struct Rastered {
  Visibility visibility;
  Mask covered;  ///< where any surface of the frame is
};

/// The nearest patch at the centre of each sample of `target`; a patch seen from behind covers what lies
/// behind it, too.
[[nodiscard]] Rastered raster(const SurfacePatches& patches, const Camera& target);

}  // namespace promenade::ibr
