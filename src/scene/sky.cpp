#include "src/scene/sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "src/core/display.h"
#include "src/core/errors.h"

namespace promenade {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr Size kSize{512, 256};
constexpr double kGroundAlbedo = 0.2;
constexpr double kSunKiloLux = 128.0;  // extraterrestrial illuminance
// Half-width of the soft sun, some five times the sun's radius: four pixels across.
constexpr double kSunSigma = 0.0218;

/// The five parameters of the Perez function, linear in turbidity (Preetham 1999, appendix A.2).
struct Perez {
  double a, b, c, d, e;

  /// Equation 3, without the zenith value. theta: from the zenith; gamma: from the sun.
  [[nodiscard]] double at(double cosTheta, double gamma) const {
    const double cosGamma = std::cos(gamma);
    return (1.0 + a * std::exp(b / cosTheta)) * (1.0 + c * std::exp(d * gamma) + e * cosGamma * cosGamma);
  }
};

Perez luminanceParameters(double t) {
  return {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
          -0.0670 * t + 0.3703};
}

Perez chromaticityX(double t) {
  return {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
          -0.0033 * t + 0.0452};
}

Perez chromaticityY(double t) {
  return {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
          -0.0109 * t + 0.0529};
}

/// Zenith luminance, kcd/m2 (appendix A.2).
double zenithLuminance(double t, double thetaSun) {
  const double chi = (4.0 / 9.0 - t / 120.0) * (kPi - 2.0 * thetaSun);
  return (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192;
}

double zenithChromaticity(double t, double thetaSun, const std::array<std::array<double, 4>, 3>& m) {
  const std::array<double, 3> turbidity = {t * t, t, 1.0};
  double sum = 0.0;
  for (std::size_t row = 0; row < 3; ++row) {
    sum +=
        turbidity[row] * (((m[row][0] * thetaSun + m[row][1]) * thetaSun + m[row][2]) * thetaSun + m[row][3]);
  }
  return sum;
}

constexpr std::array<std::array<double, 4>, 3> kZenithX = {{{0.00166, -0.00375, 0.00209, 0.0},
                                                            {-0.02903, 0.06377, -0.03202, 0.00394},
                                                            {0.11693, -0.21196, 0.06052, 0.25886}}};
constexpr std::array<std::array<double, 4>, 3> kZenithY = {{{0.00275, -0.00610, 0.00317, 0.0},
                                                            {-0.04214, 0.08970, -0.04153, 0.00516},
                                                            {0.15346, -0.26756, 0.06670, 0.26688}}};

/// Linear Rec.709 of chromaticity x, y and luminance (ITU-R BT.709 primaries, D65), cut at 0 and brought back
/// to the luminance.
Rgb toRgb(double x, double y, double luminanceValue) {
  const double bigX = x / y;
  const double bigZ = (1.0 - x - y) / y;
  const Rgb cut(std::max(0.0, 3.2404542 * bigX - 1.5371385 - 0.4985314 * bigZ),
                std::max(0.0, -0.9692660 * bigX + 1.8760108 + 0.0415560 * bigZ),
                std::max(0.0, 0.0556434 * bigX - 0.2040259 + 1.0572252 * bigZ));
  return cut * static_cast<float>(luminanceValue / std::max(1e-6, static_cast<double>(luminance(cut))));
}

/// Illuminance of the sun at normal incidence, klx as linear Rec.709 (appendix A.1: equations for tau_r and
/// tau_a).
Rgb sunIlluminance(double t, double elevation) {
  const double thetaDegrees = 90.0 - elevation * 180.0 / kPi;
  const double airMass = 1.0 / (std::sin(elevation) + 0.15 * std::pow(93.885 - thetaDegrees, -1.253));
  const double beta = 0.04608365822050 * t - 0.04586025928522;
  constexpr std::array<double, 3> kMicrometres = {0.61, 0.55,
                                                  0.465};  // where the channels' matching functions peak
  Rgb result;
  for (int i = 0; i < 3; ++i) {
    const double lambda = kMicrometres[static_cast<std::size_t>(i)];
    const double rayleigh = std::exp(-0.008735 * std::pow(lambda, -4.08) * airMass);
    const double aerosol = std::exp(-beta * std::pow(lambda, -1.3) * airMass);
    result[i] = static_cast<float>(kSunKiloLux * rayleigh * aerosol);
  }
  return result;
}

/// World direction at the centre of pixel (x, y), as Environment has it.
glm::dvec3 directionAt(int x, int y) {
  const double azimuth = ((x + 0.5) / kSize.width - 0.5) * 2.0 * kPi;
  const double theta = (y + 0.5) / kSize.height * kPi;
  return {std::sin(azimuth) * std::sin(theta), std::cos(theta), -std::cos(azimuth) * std::sin(theta)};
}

double pixelSolidAngle(int y) {
  const double top = std::cos(kPi * y / kSize.height);
  const double bottom = std::cos(kPi * (y + 1) / kSize.height);
  return (top - bottom) * 2.0 * kPi / kSize.width;
}

}  // namespace

Environment clearSky(double sunElevationRadians, double sunAzimuthRadians, double turbidity, SunDisc sun) {
  if (!(sunElevationRadians >= 0.0 && sunElevationRadians <= kPi / 2.0 + 1e-9)) {
    throw InputError("sky", "expected a sun elevation from 0 to 90 degrees, found " +
                                std::to_string(sunElevationRadians * 180.0 / kPi));
  }
  if (!std::isfinite(sunAzimuthRadians)) {
    throw InputError("sky", "the sun's azimuth is not a number");
  }
  if (!(turbidity >= 1.7 && turbidity <= 10.0)) {
    throw InputError("sky", "expected a turbidity from 1.7 to 10, found " + std::to_string(turbidity));
  }
  const double elevation = std::min(sunElevationRadians, kPi / 2.0);
  const double thetaSun = kPi / 2.0 - elevation;
  const glm::dvec3 toSun(std::sin(sunAzimuthRadians) * std::cos(elevation), std::sin(elevation),
                         -std::cos(sunAzimuthRadians) * std::cos(elevation));
  const std::array<Perez, 3> perez = {chromaticityX(turbidity), chromaticityY(turbidity),
                                      luminanceParameters(turbidity)};
  const double zenithX = zenithChromaticity(turbidity, thetaSun, kZenithX);
  const double zenithY = zenithChromaticity(turbidity, thetaSun, kZenithY);
  const auto atZenith = [&](const Perez& function) { return function.at(1.0, thetaSun); };

  RadianceMap radiance(kSize);
  double lobe = 0.0;  // integral of the sun's lobe over the pixels above the horizon
  const auto sunShape = [&](const glm::dvec3& direction) {
    const double angle = std::acos(std::clamp(glm::dot(direction, toSun), -1.0, 1.0));
    return std::exp(-0.5 * angle * angle / (kSunSigma * kSunSigma));
  };
  const int horizon = kSize.height / 2;
  for (int y = 0; y < horizon; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const glm::dvec3 direction = directionAt(x, y);
      const double gamma = std::acos(std::clamp(glm::dot(direction, toSun), -1.0, 1.0));
      radiance(x, y) = toRgb(zenithX * perez[0].at(direction.y, gamma) / atZenith(perez[0]),
                             zenithY * perez[1].at(direction.y, gamma) / atZenith(perez[1]),
                             std::max(1e-4, perez[2].at(direction.y, gamma) / atZenith(perez[2])));
      lobe += sunShape(direction) * pixelSolidAngle(y);
    }
  }
  if (sun == SunDisc::kSoft && lobe > 0.0) {
    const double perZenith = 1.0 / std::max(0.1, zenithLuminance(turbidity, thetaSun));
    const Rgb peak = sunIlluminance(turbidity, elevation) * static_cast<float>(perZenith / lobe);
    for (int y = 0; y < horizon; ++y) {
      for (int x = 0; x < kSize.width; ++x) {
        radiance(x, y) += peak * static_cast<float>(sunShape(directionAt(x, y)));
      }
    }
  }
  glm::dvec3 irradiance(0.0);
  for (int y = 0; y < horizon; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      irradiance += glm::dvec3(radiance(x, y)) * (directionAt(x, y).y * pixelSolidAngle(y));
    }
  }
  const Rgb ground(irradiance * (kGroundAlbedo / kPi));
  for (int y = horizon; y < kSize.height; ++y) {
    std::fill(radiance.row(y).begin(), radiance.row(y).end(), ground);
  }
  Environment environment;
  environment.radiance = std::move(radiance);
  return environment;
}

}  // namespace promenade
