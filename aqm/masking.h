#pragma once
// Masking: a channel that already responds to the image needs a larger change to notice it.
// T = (1 + |Y|^4)^(1/4): threshold elevation of Daly 1993, section 6, with slope 1 and its knee at the
// channel's own threshold, low-passed over the channel's extent (Eriksson et al. 1998); mutual masking: the
// lesser of the two frames' elevations.

#include "aqm/channels.h"
#include "aqm/plane.h"

namespace promenade::aqm {

class GaussianKernel;

/// (1 + response^4)^(1/4) >= 1.
[[nodiscard]] double thresholdElevation(double response);

/// Sums the masked differences d = |Ytest - Yreference| / T of the channels, as d^3.5.
class DifferenceSum {
 public:
  explicit DifferenceSum(Size image);

  /// `band` of the channel: its elevation is low-passed with sigma = 0.375 * 2^band pixels.
  void add(const Responses& responses, int band);

  /// sum d^3.5 of the channels added so far, in the order in which they were added; 0 beyond the image's
  /// width.
  [[nodiscard]] const Plane<float>& powers() const { return powers_; }

 private:
  void filterRows(const Plane<float>& responses, const GaussianKernel& kernel, Plane<float>& to) const;

  Size image_;
  Plane<float> powers_;
  Plane<float> testElevation_;  ///< low-passed along the rows only
  Plane<float> referenceElevation_;
};

}  // namespace promenade::aqm
