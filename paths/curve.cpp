#include "paths/curve.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>

namespace promenade::paths {
namespace {

// Gauss-Legendre, five points on [0, 1].
constexpr std::array<double, 5> kNodes = {0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842,
                                          0.953089922969332};
constexpr std::array<double, 5> kWeights = {0.118463442528095, 0.239314335249683, 0.284444444444444,
                                            0.239314335249683, 0.118463442528095};

// Derivative at `b`, times the knot interval [b, c], of the non-uniform Catmull-Rom spline through a, b, c, d
// (Barry, Goldman 1988) with knots centripetally spaced.
glm::dvec3 tangent(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double before = std::sqrt(glm::distance(a, b));
  const double after = std::sqrt(glm::distance(b, c));
  return after * ((b - a) / before - (c - a) / (before + after) + (c - b) / after);
}

}  // namespace

Curve::Curve(std::span<const glm::dvec3> points, CurveKind kind) {
  assert(points.size() >= 2);
  lengthAt_.push_back(0.0);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const glm::dvec3& from = points[i];
    const glm::dvec3& to = points[i + 1];
    Segment s{from, to - from, glm::dvec3(0.0), glm::dvec3(0.0), {}};
    const bool moves = glm::distance(from, to) > 0.0;
    if (kind == CurveKind::kCatmullRom && moves) {
      glm::dvec3 previous = i > 0 ? points[i - 1] : from;
      glm::dvec3 next = i + 2 < points.size() ? points[i + 2] : to;
      if (glm::distance(previous, from) <= 0.0) previous = 2.0 * from - to;
      if (glm::distance(next, to) <= 0.0) next = 2.0 * to - from;
      const glm::dvec3 leave = tangent(previous, from, to);
      // The same at the far end, walked backwards.
      const glm::dvec3 arrive = -tangent(next, to, from);
      s.c1 = leave;
      s.c2 = 3.0 * (to - from) - 2.0 * leave - arrive;
      s.c3 = 2.0 * (from - to) + leave + arrive;
    }
    for (int piece = 0; piece < kPieces; ++piece) {
      double sum = 0.0;
      for (std::size_t k = 0; k < kNodes.size(); ++k) {
        const double u = (piece + kNodes[k]) / kPieces;
        sum += kWeights[k] * glm::length(s.c1 + u * (2.0 * s.c2 + 3.0 * u * s.c3));
      }
      const auto p = static_cast<std::size_t>(piece);
      s.lengthAt[p + 1] = s.lengthAt[p] + sum / kPieces;
    }
    lengthAt_.push_back(lengthAt_.back() + s.lengthAt.back());
    segments_.push_back(s);
  }
}

glm::dvec3 Curve::at(double distance) const {
  const Location where = locate(lengthAt_, distance);
  const Segment& s = segments_[where.segment];
  const double wanted = where.u * s.lengthAt.back();
  const Location piece = locate(s.lengthAt, wanted);
  double u = (static_cast<double>(piece.segment) + piece.u) / kPieces;
  // The length within a piece is nearly linear in u; two Newton steps make the linear guess exact.
  for (int step = 0; step < 2; ++step) {
    const double start = static_cast<double>(piece.segment) / kPieces;
    double length = s.lengthAt[piece.segment];
    for (std::size_t k = 0; k < kNodes.size(); ++k) {
      const double v = start + (u - start) * kNodes[k];
      length += (u - start) * kWeights[k] * glm::length(s.c1 + v * (2.0 * s.c2 + 3.0 * v * s.c3));
    }
    const double speed = glm::length(s.c1 + u * (2.0 * s.c2 + 3.0 * u * s.c3));
    if (!(speed > 1e-12 * s.lengthAt.back()) || s.lengthAt.back() <= 0.0) break;
    u = std::clamp(u - (length - wanted) / speed, 0.0, 1.0);
  }
  return s.c0 + u * (s.c1 + u * (s.c2 + u * s.c3));
}

MonotoneCubic::MonotoneCubic(std::span<const double> times, std::span<const double> values)
    : times_(times.begin(), times.end()), values_(values.begin(), values.end()), slopes_(times.size()) {
  assert(times.size() == values.size() && times.size() >= 2);
  const std::size_t last = times.size() - 1;
  const auto rise = [&](std::size_t i) { return (values[i + 1] - values[i]) / (times[i + 1] - times[i]); };
  slopes_.front() = rise(0);
  slopes_.back() = rise(last - 1);
  for (std::size_t i = 1; i < last; ++i) {
    const double left = rise(i - 1);
    const double right = rise(i);
    if (left <= 0.0 || right <= 0.0) continue;
    const double before = times[i] - times[i - 1];
    const double after = times[i + 1] - times[i];
    slopes_[i] = 3.0 * (before + after) / ((2.0 * after + before) / left + (after + 2.0 * before) / right);
  }
}

double MonotoneCubic::at(double time) const {
  const Location where = locate(times_, time);
  const std::size_t i = where.segment;
  const double h = times_[i + 1] - times_[i];
  const double u = where.u;
  const double v = 1.0 - u;
  return values_[i] * v * v * (1.0 + 2.0 * u) + values_[i + 1] * u * u * (3.0 - 2.0 * u) +
         h * u * v * (slopes_[i] * v - slopes_[i + 1] * u);
}

double linearAt(std::span<const double> times, std::span<const double> values, double time) {
  const Location where = locate(times, time);
  return values[where.segment] + where.u * (values[where.segment + 1] - values[where.segment]);
}

Location locate(std::span<const double> times, double time) {
  assert(times.size() >= 2);
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  const auto index = std::clamp<std::ptrdiff_t>(after - times.begin() - 1, 0, std::ssize(times) - 2);
  const auto i = static_cast<std::size_t>(index);
  const double width = times[i + 1] - times[i];
  return {i, width > 0.0 ? std::clamp((time - times[i]) / width, 0.0, 1.0) : 0.0};
}

}  // namespace promenade::paths
