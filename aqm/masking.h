#pragma once
// Masking: a channel that already responds to the image needs a larger change to notice it.
// Unit knee: T = (1 + |Y|^4)^(1/4), threshold elevation of Daly 1993, section 6, with slope 1 and its knee at
// the channel's own threshold, low-passed over the channel's extent (Eriksson et al. 1998). Daly's own: T =
// (1 + (k1 (k2 |Y|)^s)^4)^(1/4), k1 = 0.0153, k2 = 392.5. Mutual masking: the lesser of the two frames'
// elevations.

#include "aqm/channels.h"
#include "aqm/plane.h"

namespace promenade::aqm {

class GaussianKernel;

/// The slope s of Daly's elevation in band 1 .. K + 1: 1, but 0.8 in band K and 0.7 in the baseband, where
/// observers learn to look past a mask.
[[nodiscard]] double dalySlope(int band, int bands);

/// T(response) >= 1 of a channel whose slope is `slope` (of Elevation::kDaly only).
[[nodiscard]] double thresholdElevation(double response, Elevation elevation = Elevation::kUnitKnee,
                                        double slope = 1.0);

/// Sums the masked differences d = |Ytest - Yreference| / T of the channels, as d^3.5.
class DifferenceSum {
 public:
  /// `bands` is K.
  DifferenceSum(Size image, int bands, const Masking& masking, SignedMap signedMap = SignedMap::kNo);

  /// `band` of the channel: its elevation is low-passed with sigma = 0.375 * 2^band pixels.
  void add(const Responses& responses, int band);

  /// sum d^3.5 of the channels added so far, in the order in which they were added; 0 beyond the image's
  /// width.
  [[nodiscard]] const Plane<float>& powers() const { return powers_; }

  /// sum (Ytest - Yreference): the filtered difference, which has its sign. Of size 0 unless asked for.
  [[nodiscard]] const Plane<float>& changes() const { return changes_; }

 private:
  void elevate(const float* responses, double slope, float* elevations, int count) const;
  void filterRows(const Plane<float>& responses, double slope, const GaussianKernel& kernel,
                  Plane<float>& to) const;

  Size image_;
  int bands_;
  Masking masking_;
  Plane<float> powers_;
  Plane<float> changes_;
  Plane<float> testElevation_;  ///< low-passed along the rows only
  Plane<float> referenceElevation_;
};

}  // namespace promenade::aqm
