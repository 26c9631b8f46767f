#include "aqm/csf.h"

#include <algorithm>
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

namespace {

/// Both CSFs of still images are scaled to this peak (Daly's P).
constexpr double kStillPeak = 250.0;

/// Daly's S1: the band-pass shape, before it is widened towards low frequencies.
double dalyShape(double rho, const Adaptation& adaptation) {
  constexpr double kEpsilon = 0.9;
  const double a = 0.801 * std::pow(1.0 + 0.7 / adaptation.luminance, -0.2);
  const double b = 0.3 * std::pow(1.0 + 100.0 / adaptation.luminance, 0.15);
  const double area = 3.23 * std::pow(rho * rho * adaptation.squareDegrees, -0.3);
  return std::pow(std::pow(area, 5.0) + 1.0, -0.2) * a * kEpsilon * rho * std::exp(-b * kEpsilon * rho) *
         std::sqrt(1.0 + 0.06 * std::exp(b * kEpsilon * rho));
}

}  // namespace

double dalySensitivity(double cyclesPerDegree, double angle, const Adaptation& adaptation) {
  if (cyclesPerDegree == 0.0) {
    return 0.0;
  }
  constexpr double kOblique = 0.78;
  const double distance = 0.856 * std::pow(adaptation.distanceMetres, 0.14);
  const double eccentricity = 1.0 / (1.0 + 0.24 * adaptation.eccentricityDegrees);
  const double oblique = 0.5 * (1.0 - kOblique) * std::cos(4.0 * angle) + 0.5 * (1.0 + kOblique);
  const double stretched = cyclesPerDegree / (distance * eccentricity * oblique);
  return kStillPeak * std::min(dalyShape(cyclesPerDegree, adaptation), dalyShape(stretched, adaptation));
}

double stillFactor(double cyclesPerDegree, const Adaptation& adaptation) {
  if (cyclesPerDegree == 0.0) {
    return 0.0;
  }
  return dalySensitivity(cyclesPerDegree, 0.0, adaptation) / sensitivity(cyclesPerDegree, kDriftSpeed);
}

double mannosSakrisonSensitivity(double cyclesPerDegree) {
  if (cyclesPerDegree == 0.0) {
    return 0.0;
  }
  const double scaled = 0.114 * cyclesPerDegree;
  return kStillPeak * 2.6 * (0.0192 + scaled) * std::exp(-std::pow(scaled, 1.1));
}

}  // namespace promenade::aqm
