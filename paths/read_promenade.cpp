#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "paths/json_reader.h"
#include "paths/limits.h"
#include "paths/read_path.h"
#include "paths/rotation.h"
#include "src/core/errors.h"

namespace promenade::paths {
namespace {

Key keyFrom(const Json& value, double fieldOfViewBefore, const std::string& where) {
  expectKeys(value, {"time", "eye", "target", "rotation", "fov"}, where);
  for (const char* needed : {"time", "eye"}) {
    if (!value.contains(needed))
      throw InputError(where, std::string("expected '") + needed + "', found none");
  }
  if (value.contains("target") == value.contains("rotation")) {
    throw InputError(where, std::string("expected 'target' or 'rotation', found ") +
                                (value.contains("target") ? "both" : "neither"));
  }
  Key key;
  key.timeSeconds = numberFrom(value["time"], kMaxTimeSeconds, where + ".time");
  key.eye = pointFrom(value["eye"], where + ".eye");
  if (value.contains("target")) {
    key.target = pointFrom(value["target"], where + ".target");
  } else {
    const auto xyzw = numbersFrom(value["rotation"], 4, 1e9, where + ".rotation");
    key.rotation = unitQuaternion(glm::dquat(xyzw[3], xyzw[0], xyzw[1], xyzw[2]), where + ".rotation");
  }
  key.verticalFieldOfView =
      value.contains("fov") ? fieldOfViewFrom(value["fov"], where + ".fov") : fieldOfViewBefore;
  return key;
}

}  // namespace

Keyframes parseKeyframes(const std::string& text, const std::string& where) {
  const Json root = parseJson(text, where);
  expectKeys(root, {"fps", "up", "interpolation", "speed", "keys"}, where);
  Keyframes result;
  result.framesPerSecond = kDefaultFramesPerSecond;
  if (root.contains("fps")) {
    result.framesPerSecond =
        checkedFramesPerSecond(numberFrom(root["fps"], 1e9, where + ": fps"), where + ": fps");
  }
  if (root.contains("up")) result.up = pointFrom(root["up"], where + ": up");
  if (root.contains("interpolation")) {
    const auto name = choiceFrom(root["interpolation"], {"catmull-rom", "linear"}, where + ": interpolation");
    result.interpolation = name == "linear" ? CurveKind::kLinear : CurveKind::kCatmullRom;
  }
  if (root.contains("speed")) {
    const auto name = choiceFrom(root["speed"], {"timed", "constant"}, where + ": speed");
    result.speed = name == "constant" ? Speed::kConstant : Speed::kTimed;
  }
  if (!root.contains("keys") || !root["keys"].is_array()) {
    throw InputError(where, "expected an array 'keys', found none");
  }
  double fieldOfView = kDefaultVerticalFieldOfViewDegrees * (std::numbers::pi / 180.0);
  for (std::size_t i = 0; i < root["keys"].size(); ++i) {
    result.keys.push_back(keyFrom(root["keys"][i], fieldOfView, element(where + ": keys", i)));
    fieldOfView = result.keys.back().verticalFieldOfView;
  }
  return result;
}

}  // namespace promenade::paths
