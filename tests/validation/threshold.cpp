#include "tests/validation/threshold.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace promenade::validation {

std::vector<Named> metrics(double pixelsPerDegree) {
  return {{"aqm", aqm::aqm(pixelsPerDegree)},
          {"revised", aqm::revisedAqm(pixelsPerDegree)},
          {"aqm2000", aqm::aqm2000(pixelsPerDegree)},
          {"vdp", aqm::vdp(pixelsPerDegree, 1.0)}};
}

double threshold(const std::function<LuminanceMap(double)>& frame, const LuminanceMap& reference,
                 const VelocityMap& velocity, const aqm::Settings& settings, double mostContrast) {
  const auto largest = [&](double contrast) {
    const aqm::Result result = aqm::compare(frame(contrast), reference, velocity, settings);
    return static_cast<double>(*std::ranges::max_element(result.pooledJnd.pixels()));
  };
  double contrast = std::min(0.01, mostContrast);
  for (int i = 0; i < 20; ++i) {
    const double found = largest(contrast);
    if (!(found > 0.0)) {
      return std::numeric_limits<double>::infinity();
    }
    // Nearly proportional to the contrast.
    const double next = contrast / found;
    if (std::abs(found - 1.0) < 2e-3 || (contrast == mostContrast && next >= mostContrast)) {
      return next;
    }
    contrast = std::min(next, mostContrast);
  }
  return contrast;
}

double decibels(double ratio) {
  return 20.0 * std::log10(ratio);
}

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double rms(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double deviation(std::span<const double> values) {
  const double centre = mean(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - centre) * (value - centre);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace promenade::validation
