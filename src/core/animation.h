#pragma once
// An animated camera as a file describes it, before it is sampled to a path (paths/from_animation.h).

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace promenade {

enum class Interpolation { kStep, kLinear, kCubicSpline };

/// One animated property (glTF 2.0, 3.11). `times` in seconds. For kCubicSpline `values` holds for each time
/// in-tangent, value, out-tangent; else one value a time. Rotations keep the file's order x, y, z, w in a
/// vec4.
template <class Value>
struct Track {
  Interpolation interpolation = Interpolation::kLinear;
  std::vector<float> times;
  std::vector<Value> values;
};

/// A node on the way from the scene's root to the camera: its rest transform and what animates it.
/// When any track is present, the rest transform is translation, rotation, scale.
struct AnimatedNode {
  std::string name;
  glm::dmat4 restMatrix{1.0};  ///< used when no track is present
  glm::dvec3 translation{0.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  // w, x, y, z
  glm::dvec3 scale{1.0};
  std::optional<Track<glm::vec3>> translationTrack;
  std::optional<Track<glm::vec4>> rotationTrack;
  std::optional<Track<glm::vec3>> scaleTrack;
};

/// A camera of the scene under one animation (or at rest: no tracks at all).
struct CameraAnimation {
  std::string name;        ///< of the animation; empty for a camera at rest
  std::string cameraName;  ///< may be empty
  double verticalFieldOfView = 0.8;
  std::vector<AnimatedNode> rootToCamera;
};

}  // namespace promenade
