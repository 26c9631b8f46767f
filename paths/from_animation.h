#pragma once
// A camera path from a glTF camera animation (glTF 2.0, 3.11 and appendix C).

#include <optional>
#include <string>

#include "paths/camera_path.h"
#include "src/core/animation.h"

namespace promenade::paths {

/// Frame 0 is at the earliest key of all tracks; the walk ends at the latest: round(duration * fps) frames,
/// at least 1 (a camera at rest: one frame). `framesPerSecond` absent: 25. Scales of parents move the camera,
/// but never change its own size or handedness. Throws InputError beginning with `where` for tracks with no
/// or one key at all, times that are not finite or not strictly increasing, values that are not finite or too
/// few, zero quaternions, axes that a zero scale removes, too many frames.
[[nodiscard]] CameraPath pathFromAnimation(const CameraAnimation& animation,
                                           std::optional<double> framesPerSecond, const std::string& where);

}  // namespace promenade::paths
