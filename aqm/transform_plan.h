#pragma once
// What a comparison has to transform: how many two-dimensional real Fourier transforms of which sizes, both
// frames counted. Their time is the floor of the metric's cost.

#include <vector>

#include "aqm/metric.h"

namespace promenade::aqm {

struct PlannedTransforms {
  Size size;
  int forward = 0;
  int inverse = 0;
};

/// For compare() of frames of `size` with this velocity (empty: nothing moves), in the order of falling size.
/// Throws nothing: the arguments are those of a comparison that went well.
[[nodiscard]] std::vector<PlannedTransforms> plannedTransforms(Size size, const VelocityMap& velocity,
                                                               const Settings& settings);

}  // namespace promenade::aqm
