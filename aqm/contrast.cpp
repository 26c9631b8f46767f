#include "aqm/contrast.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <numeric>
#include <vector>

namespace promenade::aqm {
namespace {

/// Summed row by row, then down the rows: the order does not depend on the threads.
double mean(const LuminanceMap& luminance) {
  std::vector<double> rowSums(static_cast<std::size_t>(luminance.height()));
  tbb::parallel_for(0, luminance.height(), [&](int y) {
    const auto row = luminance.row(y);
    rowSums[static_cast<std::size_t>(y)] = std::accumulate(row.begin(), row.end(), 0.0);
  });
  return std::accumulate(rowSums.begin(), rowSums.end(), 0.0) / static_cast<double>(luminance.size().area());
}

}  // namespace

double coneResponse(double luminance) {
  // L / (L + 12.6 L^0.63) divided through by L^0.63, which neither overflows nor cancels.
  const double power = std::pow(luminance, 0.37);
  return power / (power + 12.6);
}

double adaptationLuminance(const LuminanceMap& a, const LuminanceMap& b) {
  return 0.5 * (mean(a) + mean(b));
}

ContrastMap contrast(const LuminanceMap& luminance, double adaptation) {
  const double adapted = coneResponse(adaptation);
  // Lm R'(Lm) = 0.37 Rm (1 - Rm), because R = p / (p + 12.6) with p = L^0.37.
  const double perContrast = 1.0 / (0.37 * adapted * (1.0 - adapted));
  ContrastMap result(luminance.size());
  tbb::parallel_for(0, luminance.height(), [&](int y) {
    const auto from = luminance.row(y);
    const auto to = result.row(y);
    for (std::size_t x = 0; x < from.size(); ++x) {
      to[x] = static_cast<float>((coneResponse(static_cast<double>(from[x])) - adapted) * perContrast);
    }
  });
  return result;
}

}  // namespace promenade::aqm
