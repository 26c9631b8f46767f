#include "paths/rotation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>

#include "paths/text.h"
#include "src/core/errors.h"

namespace promenade::paths {
namespace {

// Half the sine of the smallest angle that is told apart from "along": about 1e-6 rad.
constexpr double kParallel = 1e-6;

// Logarithm of a unit quaternion: half its rotation vector (body axes).
glm::dvec3 logarithm(const glm::dquat& q) {
  const glm::dvec3 v(q.x, q.y, q.z);
  const double sine = glm::length(v);
  if (sine < 1e-12) return v;
  return v * (std::atan2(sine, q.w) / sine);
}

glm::dquat exponential(const glm::dvec3& halfVector) {
  const double angle = glm::length(halfVector);
  const glm::dvec3 v = angle < 1e-12 ? halfVector : halfVector * (std::sin(angle) / angle);
  return glm::dquat(std::cos(angle), v.x, v.y, v.z);
}

// Without the sign choice: squad's inner interpolations must not jump to the other hemisphere.
glm::dquat slerpSameSign(const glm::dquat& from, const glm::dquat& to, double u) {
  const double cosine = std::clamp(glm::dot(from, to), -1.0, 1.0);
  const double angle = std::acos(cosine);
  const double sine = std::sin(angle);
  if (sine < 1e-9) return glm::normalize(from * (1.0 - u) + to * u);
  return glm::normalize(from * (std::sin((1.0 - u) * angle) / sine) + to * (std::sin(u * angle) / sine));
}

}  // namespace

Pose lookAt(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up, const std::string& where) {
  const glm::dvec3 toEye = eye - target;
  const double distance = glm::length(toEye);
  if (!(distance > 1e-9 * std::max(1.0, glm::length(eye)))) {
    throw InputError(where, "expected an eye apart from its target, found both at " + triple(eye));
  }
  const glm::dvec3 backward = toEye / distance;
  const glm::dvec3 side = glm::cross(glm::normalize(up), backward);
  const double sine = glm::length(side);
  if (!(sine > kParallel)) {
    throw InputError(where, "expected a view that is not along 'up' " + triple(up) +
                                ", found a target straight above or below the eye; give a rotation instead");
  }
  const glm::dvec3 right = side / sine;
  return Pose{glm::dmat3(right, glm::cross(backward, right), backward), eye};
}

Pose rigidPose(const glm::dmat3& axes, const glm::dvec3& eye, const std::string& where) {
  const double backwardLength = glm::length(axes[2]);
  const double upLength = glm::length(axes[1]);
  if (!(backwardLength > 1e-12 && upLength > 1e-12 && backwardLength < 1e12 && upLength < 1e12)) {
    throw InputError(where, "expected camera axes of a finite length above 0, found up " + triple(axes[1]) +
                                " and backward " + triple(axes[2]));
  }
  const glm::dvec3 backward = axes[2] / backwardLength;
  const glm::dvec3 side = glm::cross(axes[1] / upLength, backward);
  const double sine = glm::length(side);
  if (!(sine > kParallel)) {
    throw InputError(where, "expected camera axes at right angles, found up and backward along each other");
  }
  const glm::dvec3 right = side / sine;
  return Pose{glm::dmat3(right, glm::cross(backward, right), backward), eye};
}

glm::dquat unitQuaternion(const glm::dquat& rotation, const std::string& where) {
  const double length = std::sqrt(glm::dot(rotation, rotation));
  if (!(std::isfinite(length) && length > 1e-6)) {
    throw InputError(where, "expected a rotation quaternion x, y, z, w of a length above 0, found (" +
                                number(rotation.x) + ", " + number(rotation.y) + ", " + number(rotation.z) +
                                ", " + number(rotation.w) + ")");
  }
  return rotation / length;
}

glm::dquat slerp(const glm::dquat& from, glm::dquat to, double u) {
  if (glm::dot(from, to) < 0.0) to = -to;
  return slerpSameSign(from, to, u);
}

double angleBetween(const glm::dmat3& a, const glm::dmat3& b) {
  // |A - B| (Frobenius) = 2 sqrt(2) sin(angle / 2): precise for small angles, unlike the trace.
  double sum = 0.0;
  for (int c = 0; c < 3; ++c) sum += glm::dot(a[c] - b[c], a[c] - b[c]);
  return 2.0 * std::asin(std::min(1.0, std::sqrt(sum / 8.0)));
}

RotationSpline::RotationSpline(std::span<const double> times, std::span<const glm::dquat> rotations) {
  assert(times.size() == rotations.size() && times.size() >= 2);
  std::vector<glm::dquat> q(rotations.begin(), rotations.end());
  for (std::size_t i = 1; i < q.size(); ++i) {
    if (glm::dot(q[i - 1], q[i]) < 0.0) q[i] = -q[i];  // the shorter way round
  }
  const std::size_t count = q.size() - 1;
  std::vector<glm::dvec3> turn(count);  // half rotation vectors of the segments
  for (std::size_t i = 0; i < count; ++i) turn[i] = logarithm(glm::conjugate(q[i]) * q[i + 1]);

  // Angular velocity at each key: the non-uniform Catmull-Rom mean of its two segments.
  std::vector<glm::dvec3> velocity(q.size());
  for (std::size_t i = 0; i <= count; ++i) {
    if (i == 0 || i == count) {
      const std::size_t s = i == 0 ? 0 : count - 1;
      velocity[i] = turn[s] / (times[s + 1] - times[s]);
      continue;
    }
    const double before = times[i] - times[i - 1];
    const double after = times[i + 1] - times[i];
    const bool holds = glm::length(turn[i - 1]) < 1e-9 || glm::length(turn[i]) < 1e-9;
    velocity[i] = holds ? glm::dvec3(0.0)
                        : (turn[i - 1] * (after / before) + turn[i] * (before / after)) / (before + after);
  }
  // Shoemake 1987: squad(u) = slerp(slerp(q0, q1, u), slerp(a, b, u), 2u(1-u)), whose derivative is
  // log(q0^-1 q1) + 2 log(q0^-1 a) at u = 0 and log(q0^-1 q1) - 2 log(q1^-1 b) at u = 1; solved for a and b.
  for (std::size_t i = 0; i < count; ++i) {
    const double h = times[i + 1] - times[i];
    segments_.push_back({q[i], q[i + 1], q[i] * exponential((velocity[i] * h - turn[i]) * 0.5),
                         q[i + 1] * exponential((turn[i] - velocity[i + 1] * h) * 0.5)});
  }
}

glm::dquat RotationSpline::at(std::size_t segment, double u) const {
  assert(segment < segments_.size());
  const Segment& s = segments_[segment];
  return slerpSameSign(slerpSameSign(s.from, s.to, u), slerpSameSign(s.leave, s.arrive, u),
                       2.0 * u * (1.0 - u));
}

}  // namespace promenade::paths
