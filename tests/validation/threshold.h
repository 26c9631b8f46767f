#pragma once
// The contrast at which the metric finds a pattern just visible.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "aqm/metric.h"

namespace promenade::validation {

struct Named {
  std::string name;
  aqm::Settings settings;
};

/// The published metrics and this project's, with their own gains.
[[nodiscard]] std::vector<Named> metrics(double pixelsPerDegree);

/// `frame`(contrast) against `reference`: the contrast at which the largest Jp is 1, to 0.2 %. Infinite if
/// nothing shows up to 1000 times full contrast (frames may clamp; the search then extrapolates from the
/// largest Jp below).
[[nodiscard]] double threshold(const std::function<LuminanceMap(double)>& frame,
                               const LuminanceMap& reference, const VelocityMap& velocity,
                               const aqm::Settings& settings, double mostContrast = 0.95);

/// 20 log10(ratio).
[[nodiscard]] double decibels(double ratio);
[[nodiscard]] double mean(std::span<const double> values);
/// Root of the mean square.
[[nodiscard]] double rms(std::span<const double> values);
/// Around the mean.
[[nodiscard]] double deviation(std::span<const double> values);

}  // namespace promenade::validation
