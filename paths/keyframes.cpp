#include "paths/keyframes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "paths/limits.h"
#include "paths/rotation.h"
#include "paths/text.h"
#include "src/core/errors.h"

namespace promenade::paths {
namespace {

std::string keyName(const std::string& where, std::size_t i) {
  return where + ": keys[" + std::to_string(i) + "]";
}

void checkKeys(const Keyframes& keyframes, const std::string& where) {
  const auto& keys = keyframes.keys;
  if (keys.size() < 2) {
    throw InputError(where, "expected at least 2 keys, found " + std::to_string(keys.size()));
  }
  if (!(glm::length(keyframes.up) > 1e-12)) {
    throw InputError(where, "up: expected a direction of a length above 0, found " + triple(keyframes.up));
  }
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (!std::isfinite(keys[i].timeSeconds)) throw InputError(keyName(where, i), "expected a finite time");
    if (i > 0 && !(keys[i].timeSeconds > keys[i - 1].timeSeconds)) {
      throw InputError(keyName(where, i), "expected a time after that of the key before, " +
                                              number(keys[i - 1].timeSeconds) + " s, found " +
                                              number(keys[i].timeSeconds) + " s");
    }
  }
}

// Times of the keys after the walk begins; with constant speed proportional to the length walked.
std::vector<double> scheduleOf(const Keyframes& keyframes, const Curve& curve, const std::string& where) {
  const auto& keys = keyframes.keys;
  std::vector<double> times;
  for (const Key& key : keys) times.push_back(key.timeSeconds - keys.front().timeSeconds);
  if (keyframes.speed == Speed::kTimed) return times;

  const auto lengths = curve.lengthAtPoints();
  for (std::size_t i = 1; i < keys.size(); ++i) {
    if (!(lengths[i] - lengths[i - 1] > 1e-12 * lengths.back())) {
      throw InputError(
          keyName(where, i),
          "expected an eye apart from that of the key before, because speed is 'constant'; found both at " +
              triple(keys[i].eye) + " ('timed' allows it)");
    }
  }
  const double duration = times.back();
  for (std::size_t i = 1; i + 1 < times.size(); ++i) times[i] = duration * (lengths[i] / lengths.back());
  return times;
}

// Where a walker is along a curve through the keys.
class Along {
 public:
  Along(const std::vector<double>& times, const std::vector<glm::dvec3>& points, const Keyframes& keyframes)
      : times_(times),
        curve_(points, keyframes.interpolation),
        even_(keyframes.interpolation == CurveKind::kLinear),
        distance_(times, curve_.lengthAtPoints()) {}

  [[nodiscard]] glm::dvec3 at(double time) const {
    return curve_.at(even_ ? linearAt(times_, curve_.lengthAtPoints(), time) : distance_.at(time));
  }

 private:
  std::vector<double> times_;
  Curve curve_;
  bool even_;
  MonotoneCubic distance_;
};

std::vector<glm::dquat> rotationsOf(const Keyframes& keyframes, const std::string& where) {
  std::vector<glm::dquat> rotations;
  for (std::size_t i = 0; i < keyframes.keys.size(); ++i) {
    const Key& key = keyframes.keys[i];
    rotations.push_back(
        key.rotation
            ? unitQuaternion(*key.rotation, keyName(where, i) + ".rotation")
            : glm::quat_cast(
                  lookAt(key.eye, key.target.value(), keyframes.up, keyName(where, i)).worldFromCamera));
  }
  return rotations;
}

}  // namespace

CameraPath walkThrough(const Keyframes& keyframes, const std::string& where) {
  const auto& keys = keyframes.keys;
  checkKeys(keyframes, where);
  const double fps = checkedFramesPerSecond(keyframes.framesPerSecond, where);
  const double duration = keys.back().timeSeconds - keys.front().timeSeconds;
  const int count = frameCountOf(duration, fps, where);

  std::vector<glm::dvec3> eyes;
  std::vector<glm::dvec3> targets;
  std::vector<double> fieldsOfView;
  for (const Key& key : keys) {
    eyes.push_back(key.eye);
    if (key.target) targets.push_back(*key.target);
    fieldsOfView.push_back(key.verticalFieldOfView);
  }
  const std::vector<glm::dquat> rotations = rotationsOf(keyframes, where);
  const Curve curve(eyes, keyframes.interpolation);
  const std::vector<double> times = scheduleOf(keyframes, curve, where);
  const Along eyeAlong(times, eyes, keyframes);
  const bool looksAtTargets = targets.size() == keys.size();
  const Along targetAlong(times, looksAtTargets ? targets : eyes, keyframes);
  const RotationSpline turning(times, rotations);

  CameraPath path;
  path.framesPerSecond = fps;
  path.frames.reserve(static_cast<std::size_t>(count));
  for (int frame = 0; frame < count; ++frame) {
    const double time = std::min(frame / fps, duration);
    const Location location = locate(times, time);
    const glm::dvec3 eye = keyframes.speed == Speed::kConstant ? curve.at(curve.length() * (time / duration))
                                                               : eyeAlong.at(time);
    Pose pose;
    if (looksAtTargets) {
      pose = lookAt(eye, targetAlong.at(time), keyframes.up, where + ": at " + number(time) + " s");
    } else if (keyframes.interpolation == CurveKind::kLinear) {
      pose = {glm::mat3_cast(slerp(rotations[location.segment], rotations[location.segment + 1], location.u)),
              eye};
    } else {
      pose = {glm::mat3_cast(turning.at(location.segment, location.u)), eye};
    }
    path.frames.push_back({pose, linearAt(times, fieldsOfView, time)});
  }
  return path;
}

}  // namespace promenade::paths
