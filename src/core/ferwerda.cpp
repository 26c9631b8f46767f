// A departure from the paper: how thresholds come down after a change of light is not tabulated from
// measurements that last minutes, but follows the adaptation of the walk (adaptation.h). After a change in
// either direction they are above those of the steady state, as Ferwerda et al. say; here by as much
// as an eye adapted to the same distance above the steady luminance, on a logarithmic scale, would have.

#include "src/core/ferwerda.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/core/display.h"

namespace promenade {
namespace {

double logOf(double luminance) {
  return std::log10(std::max(luminance, 1e-12));
}

/// Variance, square degrees, of the Gaussian that stands for an eye: its Fourier transform exp(-2 pi^2 s^2
/// f^2) is `contrast` at its acuity f.
double blurVariance(double adaptation, double contrast) {
  const double f = acuity(adaptation);
  return -std::log(contrast) / (2.0 * std::numbers::pi * std::numbers::pi * f * f);
}

}  // namespace

double coneThreshold(double adaptation) {
  const double x = logOf(adaptation);
  if (x <= -2.6) return std::pow(10.0, -0.72);
  if (x >= 1.9) return std::pow(10.0, x - 1.255);
  return std::pow(10.0, std::pow(0.249 * x + 0.65, 2.7) - 0.72);
}

double rodThreshold(double adaptation) {
  const double x = logOf(adaptation);
  if (x <= -3.94) return std::pow(10.0, -2.86);
  if (x >= -1.44) return std::pow(10.0, x - 0.395);
  return std::pow(10.0, std::pow(0.405 * x + 1.6, 2.18) - 2.86);
}

double rodShare(double adaptation) {
  constexpr double kStars = 0.01;
  constexpr double kDay = 10.0;
  const double t = (std::clamp(adaptation, kStars, kDay) - kStars) / (kDay - kStars);
  return (1.0 - t) * (1.0 - t);
}

double scotopicLuminance(const Rgb& candelas) {
  const glm::dvec3 xyz = xyzFromRgb(Primaries{}) * glm::dvec3(candelas);
  if (!(xyz.x > 0.0)) return 0.0;
  return std::max(xyz.y * (1.33 * (1.0 + (xyz.y + xyz.z) / xyz.x) - 1.68), 0.0);
}

double acuity(double adaptation) {
  return 17.25 * std::atan(1.4 * logOf(std::max(adaptation, 1e-4)) + 0.35) + 25.72;
}

double acuityBlurDegrees(double worldAdaptation, double displayAdaptation) {
  const double contrast = coneThreshold(displayAdaptation) / displayAdaptation;
  if (!(contrast < 1.0)) return 0.0;
  return std::sqrt(
      std::max(blurVariance(worldAdaptation, contrast) - blurVariance(displayAdaptation, contrast), 0.0));
}

Ferwerda::Scales Ferwerda::scalesAt(double adaptation, double displayAdaptation) {
  // Whatever is seen in the world is seen with cones on the display.
  const double shown = coneThreshold(displayAdaptation);
  return {shown / coneThreshold(adaptation), rodShare(adaptation) * shown / rodThreshold(adaptation)};
}

Ferwerda::Ferwerda(const Adaptation& world, double displayAdaptation) {
  const double elevated = std::max(world.now, world.steady * world.steady / world.now);
  scales_ = scalesAt(elevated, displayAdaptation);
  // While the eye adapts the picture's contrasts change, not its overall luminance: that of grey of the
  // steady luminance is kept (Ferwerda et al., section 4.3: b).
  const Scales steady = scalesAt(world.steady, displayAdaptation);
  const double scotopic = scotopicLuminance(Rgb(1.0f));
  offset_ = world.steady * (steady.cones - scales_.cones + scotopic * (steady.rods - scales_.rods));
}

Rgb Ferwerda::operator()(const Rgb& candelas) const {
  const double grey = scales_.rods > 0.0 ? scales_.rods * scotopicLuminance(candelas) : 0.0;
  return candelas * static_cast<float>(scales_.cones) + Rgb(static_cast<float>(grey + offset_));
}

}  // namespace promenade
