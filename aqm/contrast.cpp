#include "aqm/contrast.h"

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>
#include <tbb/parallel_for.h>

#include <algorithm>
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

ContrastMap fastContrast(const LuminanceMap& luminance, double adaptation) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::CappedTag<float, 8> tag;
  const auto lanes = hn::Lanes(tag);
  // With q = (L / Lm)^0.37 and Rm = p / (p + 12.6): R - Rm = Rm (1 - Rm) (q - 1) / (Rm q + 1 - Rm), which
  // does not cancel and needs no power of a large number.
  const double adapted = coneResponse(adaptation);
  const auto perAdaptation = hn::Set(tag, static_cast<float>(1.0 / adaptation));
  const auto exponent = hn::Set(tag, 0.37f);
  const auto perGain = hn::Set(tag, static_cast<float>(1.0 / 0.37));
  const auto share = hn::Set(tag, static_cast<float>(adapted));
  const auto rest = hn::Set(tag, static_cast<float>(1.0 - adapted));
  const auto one = hn::Set(tag, 1.0f);
  const auto least = hn::Set(tag, 1e-37f);
  ContrastMap result(luminance.size());
  tbb::parallel_for(0, luminance.height(), [&](int y) {
    const auto from = luminance.row(y);
    const auto to = result.row(y);
    alignas(64) float values[8] = {};
    for (std::size_t x = 0; x < from.size(); x += lanes) {
      const std::size_t count = std::min(lanes, from.size() - x);
      std::copy_n(from.data() + x, count, values);
      const auto relative = hn::Max(least, hn::Mul(hn::Load(tag, values), perAdaptation));
      const auto power = hn::Exp(tag, hn::Mul(exponent, hn::Log(tag, relative)));
      const auto change = hn::Mul(perGain, hn::Sub(power, one));
      hn::Store(hn::Div(change, hn::MulAdd(share, power, rest)), tag, values);
      std::copy_n(values, count, to.data() + x);
    }
  });
  return result;
}

}  // namespace promenade::aqm
