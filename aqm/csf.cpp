#include "aqm/csf.h"

#include <cmath>
#include <numbers>

namespace promenade::aqm {
namespace {

constexpr double kC0 = 1.14;
constexpr double kC1 = 0.67;
constexpr double kC2 = 1.7;

}  // namespace

double speedGain(double degreesPerSecond) {
  const double v = degreesPerSecond;
  const double octaves = std::abs(std::log10(kC2 * v / 3.0));
  const double k = 6.1 + 7.3 * octaves * octaves * octaves;
  const double angular = 2.0 * std::numbers::pi * kC1;
  return kC0 * kC2 * k * v * angular * angular;
}

double frequencyDecay(double degreesPerSecond) {
  return 4.0 * std::numbers::pi * kC1 * (kC2 * degreesPerSecond + 2.0) / 45.9;
}

double sensitivity(double cyclesPerDegree, double degreesPerSecond) {
  const double rho = cyclesPerDegree;
  return speedGain(degreesPerSecond) * rho * rho * std::exp(-rho * frequencyDecay(degreesPerSecond));
}

}  // namespace promenade::aqm
