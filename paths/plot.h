#pragma once
// A walk as a drawing.

#include <string>

#include "paths/camera_path.h"

namespace promenade::paths {

/// An SVG page: the walk from above (x to the right, z downwards, metres, equal scales, arrows for the view
/// directions), and speed and turn rate over time. Readable as it is and in print; no scripts, no external
/// references.
[[nodiscard]] std::string plotSvg(const CameraPath& path);

}  // namespace promenade::paths
