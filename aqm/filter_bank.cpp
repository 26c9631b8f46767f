#include "aqm/filter_bank.h"

#include <cmath>
#include <numbers>

namespace promenade::aqm {
namespace {

double dalyBaseband(double frequency, int bands) {
  const double end = std::ldexp(4.0 / 3.0, -bands);
  if (frequency >= end) {
    return 0.0;
  }
  const double deviations = frequency / (end / 3.0);
  return std::exp(-0.5 * deviations * deviations);
}

/// Of `count` applications of [1 4 6 4 1] / 16 whose taps are 1, 2, 4 .. pixels apart: the transform of
/// the kernel is cos^4(pi f).
double burtLowPass(const Frequency& frequency, int count) {
  double product = 1.0;
  for (int i = 0; i < count; ++i) {
    product *= std::cos(std::ldexp(std::numbers::pi, i) * frequency.x) *
               std::cos(std::ldexp(std::numbers::pi, i) * frequency.y);
  }
  return product * product * product * product;
}

}  // namespace

FilterBank::FilterBank(Decomposition decomposition, int bands, int orientations)
    : decomposition_(decomposition), bands_(bands), orientations_(orientations) {}

double FilterBank::radial(const Frequency& frequency, int band) const {
  const bool isBaseband = band > bands_;
  const double f = std::hypot(frequency.x, frequency.y);
  switch (decomposition_) {
    case Decomposition::kCortexEnergy:
      return isBaseband ? basebandAmplitude(f, bands_) : bandAmplitude(f, band);
    case Decomposition::kCortexAmplitude: {
      if (isBaseband) {
        return dalyBaseband(f, bands_);
      }
      if (band == bands_) {
        return mesa(f, std::ldexp(1.0, 1 - band)) - dalyBaseband(f, bands_);
      }
      const double amplitude = bandAmplitude(f, band);
      return amplitude * amplitude;
    }
    case Decomposition::kLaplacianPyramid:
      return isBaseband ? burtLowPass(frequency, bands_)
                        : burtLowPass(frequency, band - 1) - burtLowPass(frequency, band);
  }
  return 0.0;
}

double FilterBank::fan(const Frequency& frequency, int orientation) const {
  if (orientation == kUnoriented) {
    return 1.0;
  }
  const double amplitude = fanAmplitude(frequency, orientation, orientations_);
  return fansAreSquared() ? amplitude * amplitude : amplitude;
}

double FilterBank::centre(int band) const {
  const bool isBaseband = band > bands_;
  if (decomposition_ == Decomposition::kLaplacianPyramid) {
    // cos^4(pi f) (1 - cos^4(2 pi f)) peaks at 0.14; the baseband falls to one half near 0.36 2^-K.
    return isBaseband ? std::ldexp(0.18, -bands_) : std::ldexp(0.56, -band);
  }
  return isBaseband ? basebandCentre(bands_) : bandCentre(band);
}

double FilterBank::lowest(int band) const {
  const bool leavesAGap = decomposition_ == Decomposition::kCortexEnergy ||
                          (decomposition_ == Decomposition::kCortexAmplitude && band < bands_);
  return leavesAGap && band <= bands_ ? std::ldexp(2.0 / 3.0, -band) : 0.0;
}

double FilterBank::highest(int band) const {
  if (decomposition_ == Decomposition::kLaplacianPyramid || band == 1) {
    return std::numbers::sqrt2 / 2.0;
  }
  return band > bands_ ? std::ldexp(4.0 / 3.0, -bands_) : std::ldexp(8.0 / 3.0, -band);
}

}  // namespace promenade::aqm
