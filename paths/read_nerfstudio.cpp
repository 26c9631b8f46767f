#include "paths/json_reader.h"
#include "paths/limits.h"
#include "paths/read_path.h"
#include "paths/rotation.h"
#include "src/core/errors.h"

namespace promenade::paths {
namespace {

constexpr double kNerfstudioFramesPerSecond = 24.0;

// Other keys of the format (aspect, keyframes, appearance, crop ...) do not concern the walk and are not
// looked at.
PathFrame frameFrom(const Json& value, const std::string& where) {
  if (!value.is_object() || !value.contains("camera_to_world") || !value.contains("fov")) {
    throw InputError(where, "expected an object with 'camera_to_world' and 'fov'");
  }
  const auto m = numbersFrom(value["camera_to_world"], 16, kMaxCoordinateMetres, where + ".camera_to_world");
  if (m[12] != 0.0 || m[13] != 0.0 || m[14] != 0.0 || m[15] != 1.0) {
    throw InputError(where + ".camera_to_world", "expected a last row of 0 0 0 1 (row-major)");
  }
  const glm::dmat3 axes(m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10]);  // by columns
  const glm::dvec3 eye(m[3], m[7], m[11]);
  return {rigidPose(axes, eye, where + ".camera_to_world"), fieldOfViewFrom(value["fov"], where + ".fov")};
}

}  // namespace

CameraPath parseNerfstudio(const std::string& text, const std::string& where) {
  const Json root = parseJson(text, where);
  if (!root.is_object() || !root.contains("camera_path") || !root["camera_path"].is_array() ||
      root["camera_path"].empty()) {
    throw InputError(where, "expected an array 'camera_path' of at least one camera, found none");
  }
  if (root.contains("camera_type") && root["camera_type"] != "perspective") {
    throw InputError(where, "camera_type: expected 'perspective', the only kind of camera that is supported");
  }
  CameraPath path;
  path.framesPerSecond = kNerfstudioFramesPerSecond;
  if (root.contains("fps")) {
    path.framesPerSecond =
        checkedFramesPerSecond(numberFrom(root["fps"], 1e9, where + ": fps"), where + ": fps");
  }
  const Json& cameras = root["camera_path"];
  if (static_cast<double>(cameras.size()) > kMaxFrames) {
    throw InputError(
        where, "camera_path: expected at most 1000000 cameras, found " + std::to_string(cameras.size()));
  }
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    path.frames.push_back(frameFrom(cameras[i], element(where + ": camera_path", i)));
  }
  return path;
}

}  // namespace promenade::paths
