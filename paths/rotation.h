#pragma once
// Rotations of cameras: looking at a point, interpolation between keys (Shoemake 1985, 1987).

#include <glm/gtc/quaternion.hpp>
#include <span>
#include <string>
#include <vector>

#include "src/core/camera.h"

namespace promenade::paths {

/// The pose at `eye` that looks at `target` with `up` (any length > 0) pointing up in the image.
/// Throws InputError, beginning with `where`, for an eye at the target and for a view along `up`.
[[nodiscard]] Pose lookAt(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up,
                          const std::string& where);

/// The nearest rigid pose to the upper 3x3 of a matrix whose columns are right, up and backward, possibly
/// scaled or slightly sheared: backward is kept, up is made orthogonal to it. Throws InputError if an axis
/// vanishes.
[[nodiscard]] Pose rigidPose(const glm::dmat3& axes, const glm::dvec3& eye, const std::string& where);

/// Scaled to length 1. Throws InputError for a quaternion that is not finite or (nearly) zero.
[[nodiscard]] glm::dquat unitQuaternion(const glm::dquat& rotation, const std::string& where);

/// Spherical linear interpolation between unit quaternions along the shorter way; u in [0, 1].
[[nodiscard]] glm::dquat slerp(const glm::dquat& from, glm::dquat to, double u);

/// Angle of the rotation between two poses, radians in [0, pi].
[[nodiscard]] double angleBetween(const glm::dmat3& a, const glm::dmat3& b);

/// Unit quaternions at increasing times, interpolated by squad with angular velocities that are continuous at
/// the keys also where keys are unevenly spaced, and zero beside a segment in which nothing turns (so that a
/// camera that holds still does not sway before it turns).
class RotationSpline {
 public:
  /// Preconditions: as many times as rotations, at least 2, times strictly increasing, rotations of unit
  /// length.
  RotationSpline(std::span<const double> times, std::span<const glm::dquat> rotations);
  /// `u` in [0, 1] within the segment from key `segment` to the next.
  [[nodiscard]] glm::dquat at(std::size_t segment, double u) const;

 private:
  struct Segment {
    glm::dquat from, to, leave, arrive;  // squad's corners
  };
  std::vector<Segment> segments_;
};

}  // namespace promenade::paths
