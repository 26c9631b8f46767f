#pragma once
// A curve through points, parametrised by its length, and the timing of a walk along it.

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace promenade::paths {

enum class CurveKind { kCatmullRom, kLinear };

/// Through every point in order. kCatmullRom: centripetal (Yuksel, Schaefer, Keyser 2011: no cusps, no loops
/// within a segment), tangents of unit-speed knots |P[i+1] - P[i]|^(1/2); the end points are mirrored
/// outwards, and so is the neighbour of a repeated point.
class Curve {
 public:
  /// Precondition: at least 2 points, finite.
  Curve(std::span<const glm::dvec3> points, CurveKind kind);

  [[nodiscard]] double length() const { return lengthAt_.back(); }
  /// Length from the start to each point, non-decreasing, as many as points.
  [[nodiscard]] std::span<const double> lengthAtPoints() const { return lengthAt_; }
  /// The point at `distance` (clamped to [0, length()]) along the curve.
  [[nodiscard]] glm::dvec3 at(double distance) const;

 private:
  static constexpr int kPieces = 32;  // of the arc-length table, a segment
  struct Segment {
    glm::dvec3 c0, c1, c2, c3;  // point(u) = c0 + u c1 + u^2 c2 + u^3 c3, u in [0, 1]
    std::array<double, kPieces + 1> lengthAt{};
  };
  std::vector<Segment> segments_;
  std::vector<double> lengthAt_;
};

/// Monotone cubic through (times[i], values[i]) (Fritsch, Butland 1984), with a zero slope beside equal
/// values: never overshoots. Preconditions: at least 2, times strictly increasing, values non-decreasing.
/// Time is clamped.
class MonotoneCubic {
 public:
  MonotoneCubic(std::span<const double> times, std::span<const double> values);
  [[nodiscard]] double at(double time) const;

 private:
  std::vector<double> times_, values_, slopes_;
};

/// Linear interpolation of values over strictly increasing times; clamped outside.
[[nodiscard]] double linearAt(std::span<const double> times, std::span<const double> values, double time);

/// The segment i (0 <= i < times.size() - 1) that holds `time`, and where in it, in [0, 1]; clamped outside.
struct Location {
  std::size_t segment;
  double u;
};
[[nodiscard]] Location locate(std::span<const double> times, double time);

}  // namespace promenade::paths
