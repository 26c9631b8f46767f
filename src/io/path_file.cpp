#include "src/io/path_file.h"

#include <array>

#include "paths/write_path.h"
#include "src/core/errors.h"
#include "src/core/nearest_name.h"
#include "src/io/text_file.h"

namespace promenade::io {

PathFormat pathFormatNamed(const std::string& name) {
  constexpr std::array<std::string_view, 4> kNames = {"promenade", "nerfstudio", "tum", "gltf"};
  constexpr std::array<PathFormat, 4> kFormats = {PathFormat::kPromenade, PathFormat::kNerfstudio,
                                                  PathFormat::kTum, PathFormat::kGltf};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (name == kNames[i]) return kFormats[i];
  }
  throw InputError("unknown path format '" + name + "'; did you mean '" + nearestName(name, kNames) + "'?");
}

paths::CameraPath readPathFile(const std::filesystem::path& file, const paths::ReadOptions& options) {
  paths::CameraPath path = paths::parsePath(readTextFile(file), file.string(), options);
  path.name = file.filename().string();
  return path;
}

void writePathFile(const std::filesystem::path& file, const paths::CameraPath& path, PathFormat format) {
  switch (format) {
    case PathFormat::kPromenade:
      return writeTextFile(file, paths::toPromenadeJson(path));
    case PathFormat::kNerfstudio:
      return writeTextFile(file, paths::toNerfstudio(path));
    case PathFormat::kTum:
      return writeTextFile(file, paths::toTum(path));
    case PathFormat::kGltf:
      return writeTextFile(file, paths::toGltf(path));
  }
}

}  // namespace promenade::io
