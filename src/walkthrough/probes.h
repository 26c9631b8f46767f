#pragma once
// Which warped samples are ray traced to check the warp: few, spread evenly, more where it is less sure.

#include <cstdint>
#include <vector>

#include "src/core/image.h"

namespace promenade::walkthrough {

/// How often a sample is probed relative to others; 0: never.
using ProbeWeights = Map<struct ProbeWeightTag, float>;

struct Probe {
  int x = 0;
  int y = 0;
  float area = 0.0f;  ///< samples that it stands for: 1 / the probability that it was chosen
};

/// About `share` (in (0, 1]) of the samples with a weight above 0, each with a probability proportional to
/// its weight (but at most 1). Stratified: the image is cut into tiles that get one probe each on average,
/// and a tile gets its due rounded up or down. In the order of tiles; depends on nothing but the arguments.
[[nodiscard]] std::vector<Probe> chooseProbes(const ProbeWeights& weights, double share, std::uint64_t seed);

}  // namespace promenade::walkthrough
