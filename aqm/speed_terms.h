#pragma once
// Few filters instead of one per speed level. What a band shows at speed v is
//   g(rho; v) = H(rho) sum_j w_j(v) S(rho_k, v) / S(rho_k, u_j) S(rho, u_j),
// a function of frequency that changes smoothly with v. All of them lie close to a space of two to five
// dimensions; so a band is transformed once for each function of a basis of that space and combined at every
// pixel with the coefficients that belong to its speed.

#include <vector>

#include "aqm/csf.h"
#include "aqm/filter_bank.h"
#include "aqm/settings.h"
#include "aqm/speed_field.h"

namespace promenade::aqm {

/// A position in the table of coefficients, per octave of speed.
inline constexpr int kSpeedSteps = 256;
/// Samples of a shape across its band, both ends included.
inline constexpr int kShapeSamples = 512;

struct SpeedTerms {
  /// Frequencies of the first and the last sample, cycles per pixel. The shapes are 0 beyond.
  double lowest = 0.0;
  double highest = 0.0;
  /// One function of frequency per term; the filter's radial part included.
  std::vector<std::vector<float>> shapes;
  /// One coefficient per term and step of speed: step i is 2^(i / kSpeedSteps) times the slowest speed.
  std::vector<std::vector<float>> coefficients;
};

/// Terms for the speeds from level `first` to level `last` (inclusive) of `levels`, in band 1 .. K + 1. At
/// every speed and frequency the sum of the terms is within `tolerance` * (largest sensitivity of the band at
/// that speed + 2) of g. `settings.csf` must be one that knows of
/// motion.
[[nodiscard]] SpeedTerms speedTerms(const FilterBank& filters, int band, const Settings& settings,
                                    const Adaptation& adaptation, const SpeedLevels& levels, int first,
                                    int last, double tolerance);

}  // namespace promenade::aqm
