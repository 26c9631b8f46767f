#include "paths/from_animation.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "paths/limits.h"
#include "paths/rotation.h"
#include "paths/text.h"
#include "src/core/errors.h"

namespace promenade::paths {
namespace {

glm::dquat quaternionFrom(const glm::dvec4& xyzw, const std::string& where) {
  return unitQuaternion(glm::dquat(xyzw.w, xyzw.x, xyzw.y, xyzw.z), where);
}

template <class Value>
bool isFinite(const Value& value) {
  for (int i = 0; i < Value::length(); ++i) {
    if (!(std::abs(value[i]) <= kMaxCoordinateMetres)) return false;
  }
  return true;
}

template <class Value>
void checkTrack(const Track<Value>& track, const std::string& where) {
  const std::size_t perKey = track.interpolation == Interpolation::kCubicSpline ? 3 : 1;
  if (track.times.empty() || track.values.size() != perKey * track.times.size()) {
    throw InputError(where, "expected " + std::to_string(perKey) +
                                " value(s) for each of at least one time, found " +
                                std::to_string(track.times.size()) + " times and " +
                                std::to_string(track.values.size()) + " values");
  }
  for (std::size_t i = 0; i < track.times.size(); ++i) {
    const double time = static_cast<double>(track.times[i]);
    if (!(std::abs(time) <= kMaxTimeSeconds))
      throw InputError(where, "expected finite times, found " + number(time));
    if (i > 0 && !(track.times[i] > track.times[i - 1])) {
      throw InputError(where, "expected strictly increasing times, found " + number(time) + " s after " +
                                  number(static_cast<double>(track.times[i - 1])) + " s");
    }
  }
  for (const Value& value : track.values) {
    if (!isFinite(value)) throw InputError(where, "expected finite values of at most 1e9");
  }
}

/// Where `time` lies among the keys of a track; before the first and after the last key the end values hold.
struct Place {
  std::size_t from, to;
  double u;        // in [0, 1]
  double seconds;  // between the two keys
};

Place placeIn(const std::vector<float>& times, double time) {
  const auto after = std::upper_bound(times.begin(), times.end(), time,
                                      [](double t, float key) { return t < static_cast<double>(key); });
  if (after == times.begin()) return {0, 0, 0.0, 0.0};
  const auto from = static_cast<std::size_t>(after - times.begin()) - 1;
  if (after == times.end()) return {from, from, 0.0, 0.0};
  const double start = static_cast<double>(times[from]);
  const double seconds = static_cast<double>(times[from + 1]) - start;
  return {from, from + 1, (time - start) / seconds, seconds};
}

// glTF 2.0, appendix C.5: Hermite with the out-tangent of one key and the in-tangent of the next, times the
// interval.
template <class Result, class Value>
Result cubic(const std::vector<Value>& values, const Place& p) {
  const auto part = [&](std::size_t key, std::size_t which) { return Result(values[3 * key + which]); };
  if (p.from == p.to) return part(p.from, 1);
  const double u = p.u;
  const double u2 = u * u;
  const double u3 = u2 * u;
  return (2.0 * u3 - 3.0 * u2 + 1.0) * part(p.from, 1) + p.seconds * (u3 - 2.0 * u2 + u) * part(p.from, 2) +
         (-2.0 * u3 + 3.0 * u2) * part(p.to, 1) + p.seconds * (u3 - u2) * part(p.to, 0);
}

glm::dvec3 vectorAt(const Track<glm::vec3>& track, double time) {
  const Place p = placeIn(track.times, time);
  if (track.interpolation == Interpolation::kCubicSpline) return cubic<glm::dvec3>(track.values, p);
  const glm::dvec3 from(track.values[p.from]);
  if (track.interpolation == Interpolation::kStep) return from;
  return glm::mix(from, glm::dvec3(track.values[p.to]), p.u);
}

glm::dquat rotationAt(const Track<glm::vec4>& track, double time, const std::string& where) {
  const Place p = placeIn(track.times, time);
  if (track.interpolation == Interpolation::kCubicSpline) {
    return quaternionFrom(cubic<glm::dvec4>(track.values, p), where);
  }
  const glm::dquat from = quaternionFrom(glm::dvec4(track.values[p.from]), where);
  if (track.interpolation == Interpolation::kStep) return from;
  return slerp(from, quaternionFrom(glm::dvec4(track.values[p.to]), where), p.u);
}

struct Span {
  double first = std::numeric_limits<double>::infinity();
  double last = -std::numeric_limits<double>::infinity();
  std::size_t mostKeys = 0;

  void include(const std::vector<float>& times) {
    first = std::min(first, static_cast<double>(times.front()));
    last = std::max(last, static_cast<double>(times.back()));
    mostKeys = std::max(mostKeys, times.size());
  }
};

std::string nodeName(const AnimatedNode& node, const std::string& where) {
  return where + ": node '" + node.name.substr(0, 60) + "'";
}

Span checkedSpan(const CameraAnimation& animation, const std::string& where) {
  Span span;
  for (const AnimatedNode& node : animation.rootToCamera) {
    const auto include = [&](const auto& track, const char* property) {
      if (!track) return;
      checkTrack(*track, nodeName(node, where) + ": " + property);
      span.include(track->times);
    };
    include(node.translationTrack, "translation");
    include(node.rotationTrack, "rotation");
    include(node.scaleTrack, "scale");
  }
  return span;
}

glm::dmat4 localMatrix(const AnimatedNode& node, double time, const std::string& where) {
  if (!node.translationTrack && !node.rotationTrack && !node.scaleTrack) return node.restMatrix;
  const std::string place = nodeName(node, where);
  const glm::dvec3 translation =
      node.translationTrack ? vectorAt(*node.translationTrack, time) : node.translation;
  const glm::dquat rotation = node.rotationTrack ? rotationAt(*node.rotationTrack, time, place)
                                                 : unitQuaternion(node.rotation, place);
  const glm::dvec3 scale = node.scaleTrack ? vectorAt(*node.scaleTrack, time) : node.scale;
  return glm::scale(glm::translate(glm::dmat4(1.0), translation) * glm::mat4_cast(rotation), scale);
}

Pose poseAt(const CameraAnimation& animation, double time, const std::string& where) {
  glm::dmat4 world(1.0);
  for (const AnimatedNode& node : animation.rootToCamera) world = world * localMatrix(node, time, where);
  const std::string place = where + ": at " + number(time) + " s";
  const glm::dvec3 eye(world[3]);
  if (!isFinite(eye))
    throw InputError(place, "expected a camera within 1e9 m of the origin, found " + triple(eye));
  return rigidPose(glm::dmat3(world), eye, place);
}

}  // namespace

CameraPath pathFromAnimation(const CameraAnimation& animation, std::optional<double> framesPerSecond,
                             const std::string& where) {
  const std::string name = animation.name.substr(0, 60);
  const std::string place = name.empty() ? where : where + ": animation '" + name + "'";
  const double fieldOfView = animation.verticalFieldOfView;
  if (!(fieldOfView > 0.0 && fieldOfView < 3.14159)) {
    throw InputError(place,
                     "expected a vertical field of view between 0 and pi, found " + number(fieldOfView));
  }
  CameraPath path;
  path.name = animation.name;
  path.framesPerSecond = checkedFramesPerSecond(framesPerSecond.value_or(kDefaultFramesPerSecond), place);

  const Span span = checkedSpan(animation, place);
  if (span.mostKeys == 0) {  // a camera at rest
    path.frames.push_back({poseAt(animation, 0.0, place), fieldOfView});
    return path;
  }
  if (!(span.last > span.first)) {
    throw InputError(place, "expected keys at two or more times, found all at " + number(span.first) + " s");
  }
  const int count = frameCountOf(span.last - span.first, path.framesPerSecond, place);
  path.frames.reserve(static_cast<std::size_t>(count));
  for (int frame = 0; frame < count; ++frame) {
    path.frames.push_back({poseAt(animation, span.first + frame / path.framesPerSecond, place), fieldOfView});
  }
  return path;
}

}  // namespace promenade::paths
