#pragma once
// From the channels' differences to what a viewer notices: Minkowski summation over the channels at a point,
// and over half a degree around it (probability summation, Daly 1993, section 7; pooling, Eriksson et al.
// 1998).

#include "aqm/metric.h"
#include "aqm/plane.h"
#include "src/core/image.h"

namespace promenade::aqm {

/// J = (sum_channels d^3.5)^(1/3.5) of the image's size, from the sums.
[[nodiscard]] JndMap sharpJnd(const Plane<float>& powers);

/// Jp^3.5 = 2 pi 0.5^2 gauss(J^3.5): the integral, in square degrees, under a Gaussian window of standard
/// deviation 0.5 degrees and height 1. Beyond the image there is nothing to see: zero.
[[nodiscard]] Plane<float> pooledPowers(const Plane<float>& powers, double pixelsPerDegree);

/// (Jp^3.5)^(1/3.5).
[[nodiscard]] JndMap pooledJnd(const Plane<float>& pooled);

/// P = 1 - exp(-Jp^3.5): Jp = 1 is where P = 1 - 1/e = 0.632.
[[nodiscard]] ProbabilityMap detectionProbability(const Plane<float>& pooled);

/// The probability with the sign of the change: positive where the test frame looks brighter; 0 where the
/// changes of the channels cancel exactly, so that swapping the frames changes nothing but signs.
[[nodiscard]] SignedProbabilityMap signedProbability(const ProbabilityMap& probability,
                                                     const Plane<float>& changes);

}  // namespace promenade::aqm
