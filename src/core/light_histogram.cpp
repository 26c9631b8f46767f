#include "src/core/light_histogram.h"

#include <algorithm>
#include <cmath>

namespace promenade {

LightHistogram lightHistogram(std::span<const double> luminances) {
  LightHistogram histogram;
  if (luminances.empty()) return histogram;
  histogram.shares.assign(LightHistogram::kBins, 0.0);
  const double share = 1.0 / static_cast<double>(luminances.size());
  for (const double l : luminances) {
    const double lowest = std::pow(10.0, LightHistogram::kLowest);
    const double place = (std::log10(std::max(l, lowest)) - LightHistogram::kLowest) / LightHistogram::kStep;
    const double clamped = std::clamp(place, 0.0, LightHistogram::kBins - 1.0);
    const int bin = std::min(static_cast<int>(clamped), LightHistogram::kBins - 2);
    const double t = clamped - bin;
    histogram.shares[static_cast<std::size_t>(bin)] += (1.0 - t) * share;
    histogram.shares[static_cast<std::size_t>(bin) + 1] += t * share;
  }
  return histogram;
}

LightHistogram mixed(const LightHistogram& a, const LightHistogram& b, double t) {
  if (a.shares.empty()) return b;
  if (b.shares.empty()) return a;
  LightHistogram mix = a;
  for (std::size_t i = 0; i < mix.shares.size(); ++i) mix.shares[i] += t * (b.shares[i] - a.shares[i]);
  return mix;
}

}  // namespace promenade
