#pragma once
// Which walk is meant: a file, or a camera of a scene.

#include <filesystem>
#include <optional>
#include <string>

#include "paths/camera_path.h"
#include "src/scene/scene.h"

namespace promenade::app {

/// True for .gltf and .glb, which the scene loader reads.
[[nodiscard]] bool isGltf(const std::filesystem::path& file);

/// The walk called `name` (an animation, else a camera at rest, which is a walk of one frame) in a scene;
/// empty: the first animation, else the first camera. Throws InputError if there is none, listing what there
/// is.
[[nodiscard]] paths::CameraPath pathOfScene(const Scene& scene, const std::string& name,
                                            std::optional<double> fps);

}  // namespace promenade::app
