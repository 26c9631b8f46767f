#pragma once
// How much of what is seen is how bright, on a logarithmic scale.

#include <span>
#include <vector>

namespace promenade {

/// Shares of the luminances around 10^(kLowest + i kStep) cd/m2, i = 0 .. kBins - 1; they sum to 1, or are
/// empty if there is nothing to see.
struct LightHistogram {
  static constexpr double kLowest = -4.0;  // Larson, Rushmeier, Piatko 1997: what is darker is black
  static constexpr double kStep = 0.05;
  static constexpr int kBins = 241;  // to 10^8

  std::vector<double> shares;

  [[nodiscard]] static double logOfBin(int bin) { return kLowest + kStep * bin; }
};

/// Of luminances in cd/m2. One between two bins belongs to both in proportion, so that light that changes
/// little changes little. Below the lowest bin as in it, above the highest as in that.
[[nodiscard]] LightHistogram lightHistogram(std::span<const double> luminances);

/// a + t (b - a); an empty one is as the other.
[[nodiscard]] LightHistogram mixed(const LightHistogram& a, const LightHistogram& b, double t);

}  // namespace promenade
