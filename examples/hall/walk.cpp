#include "examples/hall/walk.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include "examples/hall/picture.h"

namespace promenade::hall {
namespace {

constexpr double kEyeHeight = 1.62;
constexpr double kLineZ = 7.2;  // the middle of the last bay but one: between two columns on either side
constexpr double kStartX = -5.0;
constexpr double kEndX = 3.8;

/// Distance gone along a walk of length 1 in unit time, with velocity rising and falling smoothly (a raised
/// cosine) over the first and last `ease` of the time and steady between.
double eased(double t, double ease) {
  const double steady = 1.0 / (1.0 - ease);
  const auto rising = [&](double s) {
    return 0.5 * steady * (s - ease / glm::pi<double>() * std::sin(glm::pi<double>() * s / ease));
  };
  t = std::clamp(t, 0.0, 1.0);
  if (t < ease) return rising(t);
  if (t > 1.0 - ease) return 1.0 - rising(1.0 - t);
  return 0.5 * steady * ease + steady * (t - ease);
}

/// Degrees to the right of -Z.
double heading(double seconds) {
  const double pan = -9.0 + 13.0 * eased(seconds / 3.6, 0.4);
  const double turn = 86.0 * eased((seconds - 4.0) / 3.0, 0.45);
  return pan + turn;
}

}  // namespace

std::vector<CameraKey> walkKeys() {
  std::vector<CameraKey> keys;
  const int count = static_cast<int>(std::lround(kWalkSeconds * kWalkFramesPerSecond));
  for (int i = 0; i <= count; ++i) {
    const double seconds = i / kWalkFramesPerSecond;
    const double along = eased(seconds / kWalkSeconds, 0.2);
    // Drifts forward while it looks along the nave, and comes back to the middle of the bay for the picture.
    const double drift = 0.35 * std::pow(std::sin(glm::pi<double>() * along), 2.0);
    const glm::dvec3 eye(kStartX + (kEndX - kStartX) * along, kEyeHeight, kLineZ - drift);
    // A positive rotation about +Y turns to the left.
    keys.push_back({seconds, eye, glm::angleAxis(-glm::radians(heading(seconds)), glm::dvec3(0, 1, 0))});
  }
  return keys;
}

}  // namespace promenade::hall
