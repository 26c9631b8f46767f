#pragma once
// Camera paths as text, in each format that read_path.h and glTF readers understand. Reading the text back at
// the same frame rate gives as many frames and the same poses (glTF: to float precision; TUM: without the
// field of view).

#include <string>

#include "paths/camera_path.h"

namespace promenade::paths {

/// One key a frame with its rotation, linear; a last key closes the walk's half-open interval.
[[nodiscard]] std::string toPromenadeJson(const CameraPath& path);
[[nodiscard]] std::string toNerfstudio(const CameraPath& path);
[[nodiscard]] std::string toTum(const CameraPath& path);
/// A glTF 2.0 file (JSON, its buffer a data URI) with one animated camera, LINEAR keys. glTF cannot animate
/// the field of view: throws InputError if it changes along the path.
[[nodiscard]] std::string toGltf(const CameraPath& path);

}  // namespace promenade::paths
