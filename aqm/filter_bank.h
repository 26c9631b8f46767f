#pragma once
// The filters of every way to split an image into bands and orientations, as amplitudes over frequency.
// Cortex transform: cortex.h. Daly's own (1993, section 5): the filters themselves sum to 1, and the baseband
// is the Gaussian exp(-f^2 / 2 sigma^2), sigma = 1/3 (4/3) 2^-K, cut off at (4/3) 2^-K. Pyramid: Burt,
// Adelson 1983, with the low-pass filter [1 4 6 4 1] / 16 along rows and columns, but never decimated, so
// that nothing is aliased; times Daly's fans.

#include "aqm/cortex.h"
#include "aqm/settings.h"

namespace promenade::aqm {

class FilterBank {
 public:
  FilterBank(Decomposition decomposition, int bands, int orientations);

  [[nodiscard]] int bands() const { return bands_; }
  [[nodiscard]] int orientations() const { return orientations_; }

  /// Bands 1 (finest) .. K, and K + 1, the baseband. Frequencies in cycles per pixel.
  [[nodiscard]] double radial(const Frequency& frequency, int band) const;
  /// Whether fan() is fanAmplitude() squared (filters sum to 1) or as it is (their squares do).
  [[nodiscard]] bool fansAreSquared() const { return decomposition_ != Decomposition::kCortexEnergy; }
  /// Orientations 0 .. n - 1, or kUnoriented: 1.
  [[nodiscard]] double fan(const Frequency& frequency, int orientation) const;

  /// Of the frequency that stands for band k: where its filter peaks.
  [[nodiscard]] double centre(int band) const;
  /// Nothing below and nothing above these is passed.
  [[nodiscard]] double lowest(int band) const;
  [[nodiscard]] double highest(int band) const;

 private:
  Decomposition decomposition_;
  int bands_;
  int orientations_;
};

}  // namespace promenade::aqm
