#pragma once
// Camera path files (the text formats; glTF is read with the scene).

#include <filesystem>
#include <string>

#include "paths/camera_path.h"
#include "paths/read_path.h"

namespace promenade::io {

enum class PathFormat { kPromenade, kNerfstudio, kTum, kGltf };

/// "promenade", "nerfstudio", "tum", "gltf". Throws InputError that names the nearest.
[[nodiscard]] PathFormat pathFormatNamed(const std::string& name);

/// The format is told by the content (paths/read_path.h). Its name is the file's. Throws InputError.
[[nodiscard]] paths::CameraPath readPathFile(const std::filesystem::path& file,
                                             const paths::ReadOptions& options);

/// Whole or not at all. Throws InputError or CannotContinue (file_error.h).
void writePathFile(const std::filesystem::path& file, const paths::CameraPath& path, PathFormat format);

}  // namespace promenade::io
