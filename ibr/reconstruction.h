#pragma once
// Radiance between the samples of a source frame.
// Source: Catmull, Rom 1974; Mitchell, Netravali 1988 (the cubic with B = 0, C = 1/2).

#include <array>
#include <glm/vec2.hpp>

#include "src/core/frame.h"

namespace promenade::ibr {

struct LayeredRadiance {
  Rgb diffuse{0.0f};
  Rgb viewDependent{0.0f};
};

/// Between the samples (x, y) and (x+1, y+1), `fraction` in [0, 1] of the way.
struct Between {
  int x = 0;
  int y = 0;
  glm::vec2 fraction{0.0f};
};

/// Weights of the 2x2 samples at (x, y), (x+1, y), (x, y+1), (x+1, y+1): bilinear, sum 1.
[[nodiscard]] std::array<float, 4> bilinearWeights(const Between& at);

/// Mean of the 2x2 samples by `weights` (sum > 0, renormalised here). A sample of weight 0 is not read: it
/// may lie outside the image or hold anything. A sample that has all the weight comes back bit for bit.
[[nodiscard]] LayeredRadiance weightedMean(const Frame& source, const Between& at,
                                           const std::array<float, 4>& weights);

/// Catmull-Rom over the 4x4 samples (x-1..x+2, y-1..y+2), which must all be inside. Clamped to their range,
/// so that there is no ringing beyond an edge and no negative radiance.
[[nodiscard]] LayeredRadiance catmullRom(const Frame& source, const Between& at);

}  // namespace promenade::ibr
