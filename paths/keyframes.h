#pragma once
// Key frames of a walk, and the walk through them.
//
// Positions follow a centripetal Catmull-Rom curve (or straight lines). The curve fixes where the walk goes;
// how fast is a function of its own: with kTimed each key is passed at its time and the distance walked is a
// monotone cubic of time (no stop-and-go, never backwards; two equal positions hold still); with kConstant
// the whole length is walked at one speed between the first and the last time, and every other key's time
// follows from its place. Targets, if every key has one, are interpolated like positions; otherwise rotations
// are, by squad (or slerp). The field of view changes linearly between keys.

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "paths/camera_path.h"
#include "paths/curve.h"

namespace promenade::paths {

enum class Speed { kTimed, kConstant };

struct Key {
  double timeSeconds = 0.0;
  glm::dvec3 eye{0.0};
  std::optional<glm::dvec3> target;    ///< looked at, or
  std::optional<glm::dquat> rotation;  ///< worldFromCamera; exactly one of the two
  double verticalFieldOfView = 1.0;    ///< radians
};

struct Keyframes {
  double framesPerSecond = 25.0;
  glm::dvec3 up{0.0, 1.0, 0.0};
  CurveKind interpolation = CurveKind::kCatmullRom;
  Speed speed = Speed::kTimed;
  std::vector<Key> keys;
};

/// The walk's frames: round(duration * framesPerSecond) of them, at least 1, frame i at i / framesPerSecond
/// after the first key. Throws InputError beginning with `where` for: fewer than 2 keys, times not strictly
/// increasing, a zero or non-finite rotation, an eye at its target, a view along `up` (at a key or on the
/// way), constant speed with no length or with two equal positions in a row, more frames than kMaxFrames.
[[nodiscard]] CameraPath walkThrough(const Keyframes& keyframes, const std::string& where);

}  // namespace promenade::paths
