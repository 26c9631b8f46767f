#pragma once
// How far the fast execution of the metric is from the plain one.

#include <algorithm>
#include <cmath>
#include <vector>

#include "aqm/metric.h"

namespace promenade::aqm::tests {

struct Departure {
  double pooled = 0.0;       ///< largest |dJp| / Jp, where Jp > 0.3
  double probability = 0.0;  ///< largest |dP|
  double sharp = 0.0;    ///< 99th percentile of |dJ| / max(J, Jp), where this is > 0.3: J goes through zeros
  double percent = 0.0;  ///< |d(per cent visible)|
  double largestPooled = 0.0;
};

inline Departure departure(const LuminanceMap& test, const LuminanceMap& reference,
                           const VelocityMap& velocity, Settings settings) {
  settings.execution = Execution::kFast;
  const Result fast = compare(test, reference, velocity, settings);
  settings.execution = Execution::kPlain;
  const Result plain = compare(test, reference, velocity, settings);
  constexpr double kMatters = 0.3;
  Departure result;
  std::vector<double> sharp;
  for (std::size_t i = 0; i < plain.jnd.pixels().size(); ++i) {
    const auto pooled = static_cast<double>(plain.pooledJnd.pixels()[i]);
    const auto jnd = static_cast<double>(plain.jnd.pixels()[i]);
    result.largestPooled = std::max(result.largestPooled, pooled);
    if (pooled > kMatters) {
      result.pooled =
          std::max(result.pooled, std::abs(static_cast<double>(fast.pooledJnd.pixels()[i]) / pooled - 1.0));
    }
    const double nearby = std::max(jnd, pooled);
    if (nearby > kMatters) {
      sharp.push_back(std::abs(static_cast<double>(fast.jnd.pixels()[i]) - jnd) / nearby);
    }
    result.probability =
        std::max(result.probability,
                 static_cast<double>(std::abs(fast.probability.pixels()[i] - plain.probability.pixels()[i])));
  }
  if (!sharp.empty()) {
    const auto rank = static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(sharp.size() - 1));
    std::nth_element(sharp.begin(), sharp.begin() + rank, sharp.end());
    result.sharp = sharp[static_cast<std::size_t>(rank)];
  }
  result.percent = std::abs(percentVisible(fast.probability, {}) - percentVisible(plain.probability, {}));
  return result;
}

}  // namespace promenade::aqm::tests
