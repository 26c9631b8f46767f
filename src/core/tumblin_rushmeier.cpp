// Departure from the course notes: they print the second coefficient of beta with the wrong sign, -0.218.
// With l = x - 3.5029 (1 cd/m2 is pi / 10^4 lambert) the paper's beta is -0.4 x^2 + 0.2183 x + 6.1642, of
// which the notes have the rest; their alpha, 0.4 x + 1.519, is the paper's.

#include "src/core/tumblin_rushmeier.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace promenade {
namespace {

constexpr double kLambertsPerCandela = std::numbers::pi * 1e-4;  // lamberts of 1 cd/m2

double logLamberts(double adaptation) {
  return std::log10(kLambertsPerCandela * std::max(adaptation, 1e-2));
}

}  // namespace

double stevensAlpha(double adaptation) {
  return 0.4 * logLamberts(adaptation) + 2.92;
}

double stevensBeta(double adaptation) {
  const double l = logLamberts(adaptation);
  return -0.4 * l * l - 2.584 * l + 2.0208;
}

// Equal brightness, 10^betaW Lw^alphaW = 10^betaD Ld^alphaD in lamberts, solved for Ld in cd/m2.
TumblinRushmeier::TumblinRushmeier(double worldAdaptation, double displayAdaptation)
    : power_(stevensAlpha(worldAdaptation) / stevensAlpha(displayAdaptation)),
      factor_(std::pow(10.0, (stevensBeta(worldAdaptation) - stevensBeta(displayAdaptation)) /
                                 stevensAlpha(displayAdaptation)) *
              std::pow(kLambertsPerCandela, power_ - 1.0)) {}

double TumblinRushmeier::operator()(double worldLuminance) const {
  return factor_ * std::pow(worldLuminance, power_);
}

}  // namespace promenade
