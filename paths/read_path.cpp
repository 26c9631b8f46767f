#include "paths/read_path.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "paths/json_reader.h"
#include "paths/limits.h"
#include "paths/rotation.h"
#include "src/core/errors.h"

namespace promenade::paths {
namespace {

CameraPath fromJson(const std::string& text, const std::string& where, const ReadOptions& options) {
  const Json root = parseJson(text, where);
  if (root.is_object() && root.contains("camera_path")) {
    CameraPath path = parseNerfstudio(text, where);
    return options.framesPerSecond ? resampled(path, *options.framesPerSecond, where) : path;
  }
  if (root.is_object() && root.contains("asset")) {
    throw InputError(where, "expected a camera path, found a glTF scene (its name must end in .gltf)");
  }
  Keyframes keyframes = parseKeyframes(text, where);
  if (options.framesPerSecond) keyframes.framesPerSecond = *options.framesPerSecond;
  return walkThrough(keyframes, where);
}

}  // namespace

CameraPath parsePath(const std::string& text, const std::string& where, const ReadOptions& options) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) throw InputError(where, "expected a camera path, found an empty file");
  const bool json = text[first] == '{' || text[first] == '[';
  return json ? fromJson(text, where, options) : parseTum(text, where, options);
}

CameraPath resampled(const CameraPath& path, double framesPerSecond, const std::string& where) {
  CameraPath result;
  result.name = path.name;
  result.framesPerSecond = checkedFramesPerSecond(framesPerSecond, where);
  const double duration = static_cast<double>(path.frames.size()) / path.framesPerSecond;
  const int count = frameCountOf(duration, framesPerSecond, where);
  const double last = static_cast<double>(path.frames.size() - 1);
  for (int frame = 0; frame < count; ++frame) {
    const double position = std::min(frame / framesPerSecond * path.framesPerSecond, last);
    const auto index = static_cast<std::size_t>(position);
    const PathFrame& from = path.frames[index];
    const PathFrame& to = path.frames[std::min(index + 1, path.frames.size() - 1)];
    const double u = position - static_cast<double>(index);
    if (u <= 0.0) {
      result.frames.push_back(from);
      continue;
    }
    const glm::dquat rotation =
        slerp(glm::quat_cast(from.pose.worldFromCamera), glm::quat_cast(to.pose.worldFromCamera), u);
    result.frames.push_back({{glm::mat3_cast(rotation), glm::mix(from.pose.eye, to.pose.eye, u)},
                             glm::mix(from.verticalFieldOfView, to.verticalFieldOfView, u)});
  }
  return result;
}

}  // namespace promenade::paths
