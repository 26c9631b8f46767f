#include "src/app/path_choice.h"

#include <algorithm>
#include <vector>

#include "paths/from_animation.h"
#include "src/app/printable.h"
#include "src/core/errors.h"
#include "src/core/nearest_name.h"

namespace promenade::app {

bool isGltf(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension == ".gltf" || extension == ".glb";
}

paths::CameraPath pathOfScene(const Scene& scene, const std::string& name, std::optional<double> fps) {
  const auto& cameras = scene.cameras;
  if (cameras.empty()) {
    throw InputError(scene.source, "the scene has no camera; give a camera path with --path FILE");
  }
  const auto pick = [&](auto&& matches) {
    const auto found = std::find_if(cameras.begin(), cameras.end(), matches);
    return found == cameras.end() ? nullptr : &*found;
  };
  const CameraAnimation* chosen = nullptr;
  if (name.empty()) {
    chosen = pick([](const CameraAnimation& c) { return !c.name.empty(); });
    if (chosen == nullptr) chosen = &cameras.front();
  } else {
    chosen = pick([&](const CameraAnimation& c) { return c.name == name; });
    if (chosen == nullptr) chosen = pick([&](const CameraAnimation& c) { return c.cameraName == name; });
  }
  if (chosen == nullptr) {
    std::vector<std::string_view> names;
    for (const CameraAnimation& camera : cameras) {
      if (!camera.name.empty()) names.push_back(camera.name);
      if (!camera.cameraName.empty()) names.push_back(camera.cameraName);
    }
    throw InputError(scene.source,
                     "no camera animation or camera is called '" + printable(name) + "'" +
                         (names.empty() ? std::string(" (none has a name)")
                                        : "; did you mean '" + nearestName(name, names) + "'?"));
  }
  paths::CameraPath path = paths::pathFromAnimation(*chosen, fps, scene.source);
  if (path.name.empty()) path.name = chosen->cameraName;
  return path;
}

}  // namespace promenade::app
