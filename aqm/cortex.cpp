#include "aqm/cortex.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace promenade::aqm {
namespace {

/// How far a frequency is through the transition of width 2/3 `half` around `half`, as a quarter turn:
/// mesa = cos^2 and 1 - mesa = sin^2 of it. The square roots then need no difference of nearly equal numbers.
double transitionAngle(double frequency, double half) {
  const double start = half - half / 3.0;
  const double width = 2.0 * half / 3.0;
  return 0.5 * std::numbers::pi * std::clamp((frequency - start) / width, 0.0, 1.0);
}

/// cos and sin that are exactly 0 where the transition ends.
double falling(double frequency, double half) {
  return frequency >= half + half / 3.0 ? 0.0 : std::cos(transitionAngle(frequency, half));
}
double rising(double frequency, double half) {
  return std::sin(transitionAngle(frequency, half));
}

double squaredFan(double x, double y, int orientation, int orientations) {
  if (orientations == 1) {
    return 1.0;
  }
  const double squaredLength = x * x + y * y;
  if (squaredLength == 0.0) {
    return orientation == 0 ? 1.0 : 0.0;
  }
  const double along = glm::dot(glm::dvec2(x, y), acrossBars(orientation, orientations));
  if (orientations != kOrientations) {
    const double distance = std::acos(std::min(1.0, std::abs(along) / std::sqrt(squaredLength)));
    return orientations * distance < std::numbers::pi ? 0.5 * (1.0 + std::cos(orientations * distance)) : 0.0;
  }
  // 1/2 (1 + cos 6d) = cos^2(3d), and cos 3d = cos d (4 cos^2 d - 3), which is positive exactly where d < 30
  // degrees.
  const double squaredCosine = along * along / squaredLength;
  const double factor = 4.0 * squaredCosine - 3.0;
  return factor > 0.0 ? squaredCosine * factor * factor : 0.0;
}

}  // namespace

glm::dvec2 acrossBars(int orientation, int orientations) {
  assert(orientation >= 0 && orientation < orientations);
  // Reduced to the first quadrant, so that the axes and their mirror images are exact.
  const int twice = 2 * orientation;
  if (twice == orientations) {
    return {0.0, 1.0};
  }
  if (twice > orientations) {
    const glm::dvec2 mirrored = acrossBars(orientations - orientation, orientations);
    return {-mirrored.x, mirrored.y};
  }
  const double angle = std::numbers::pi * orientation / orientations;
  return {std::cos(angle), std::sin(angle)};
}

double signedFrequency(int index, int length) {
  const int number = 2 * index < length ? index : index - length;
  return static_cast<double>(number) / length;
}

double mesa(double frequency, double half) {
  const double cosine = falling(frequency, half);
  return cosine * cosine;
}

double bandAmplitude(double frequency, int band) {
  const double lower = std::ldexp(1.0, -band);
  // The transitions at 2^-k and 2^-(k-1) do not overlap, so the difference of two mesas is a product.
  const double low = rising(frequency, lower);
  return band == 1 ? low : low * falling(frequency, 2.0 * lower);
}

double basebandAmplitude(double frequency, int bands) {
  return falling(frequency, std::ldexp(1.0, -bands));
}

double fanAmplitude(const Frequency& frequency, int orientation, int orientations) {
  const double named = squaredFan(frequency.x, frequency.y, orientation, orientations);
  const double otherX = frequency.xIsNyquist ? frequency.x : -frequency.x;
  const double otherY = frequency.yIsNyquist ? frequency.y : -frequency.y;
  return std::sqrt(0.5 * (named + squaredFan(otherX, otherY, orientation, orientations)));
}

double bandCentre(int band) {
  return std::ldexp(4.0 / 3.0, -band);
}

double basebandCentre(int bands) {
  return std::ldexp(0.5, -bands);
}

}  // namespace promenade::aqm
