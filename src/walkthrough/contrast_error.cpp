#include "src/walkthrough/contrast_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace promenade::walkthrough {
namespace {

constexpr double kWindow = 3.0;  ///< in standard deviations
constexpr double kStandardErrors = 3.0;
/// Of fewer the standard error is itself a guess.
constexpr double kFewestProbes = 4.0;

struct Sums {
  double weight = 0.0;
  double squaredWeight = 0.0;
  double error = 0.0;
  double squaredError = 0.0;
};

float significantMean(const Sums& s) {
  if (!(s.weight > 0.0)) return 0.0f;
  // The number of equally weighted probes whose mean is as uncertain (Kish 1965).
  const double count = s.weight * s.weight / s.squaredWeight;
  if (count < kFewestProbes) return 0.0f;
  const double mean = s.error / s.weight;
  const double variance = std::max(0.0, s.squaredError / s.weight - mean * mean);
  const double standardError = std::sqrt(variance / (count - 1.0));
  const double significant = std::max(0.0, std::abs(mean) - kStandardErrors * standardError);
  return static_cast<float>(std::copysign(significant, mean));
}

}  // namespace

ContrastErrorMap contrastErrors(Size size, std::span<const ProbeError> probes, double spacingPixels) {
  assert(spacingPixels > 0.0);
  const double reach = kWindow * spacingPixels;
  const double falloff = -0.5 / (spacingPixels * spacingPixels);
  Image<Sums> sums(size);
  for (const ProbeError& probe : probes) {
    const int left = std::max(0, static_cast<int>(std::ceil(probe.pixel.x - reach - 0.5)));
    const int right = std::min(size.width - 1, static_cast<int>(std::floor(probe.pixel.x + reach - 0.5)));
    const int top = std::max(0, static_cast<int>(std::ceil(probe.pixel.y - reach - 0.5)));
    const int bottom = std::min(size.height - 1, static_cast<int>(std::floor(probe.pixel.y + reach - 0.5)));
    for (int y = top; y <= bottom; ++y) {
      for (int x = left; x <= right; ++x) {
        const double dx = x + 0.5 - probe.pixel.x;
        const double dy = y + 0.5 - probe.pixel.y;
        // Times the area, so that places that are probed more densely do not count for more.
        const double weight = probe.area * std::exp(falloff * (dx * dx + dy * dy));
        Sums& s = sums(x, y);
        s.weight += weight;
        s.squaredWeight += weight * weight;
        s.error += weight * probe.error;
        s.squaredError += weight * probe.error * probe.error;
      }
    }
  }
  ContrastErrorMap errors(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) errors(x, y) = significantMean(sums(x, y));
  }
  return errors;
}

}  // namespace promenade::walkthrough
