#pragma once
// Radiance between the samples of a source frame.
// Sources: Catmull, Rom 1974; Mitchell, Netravali 1988 (the cubic with B = 0, C = 1/2); Lancaster, Salkauskas
// 1981 (moving least squares), for what is left of the samples beside an edge.

#include <cstdint>
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

/// Which of the 4x4 samples (x-1..x+2, y-1..y+2) may be used: bit 4 j + i is sample (x-1+i, y-1+j).
using Neighbours = std::uint16_t;
inline constexpr Neighbours kInnerNeighbours = 0b0000'0110'0110'0000;

/// Catmull-Rom over the 4x4 samples, which must all be inside. Clamped to their range, so that there is no
/// ringing beyond an edge and no negative radiance.
[[nodiscard]] LayeredRadiance catmullRom(const Frame& source, const Between& at);

/// The same where the inner 2x2 samples are usable and some of the outer ones are not: those are continued
/// from the others along their row or column, by a parabola or a line.
[[nodiscard]] LayeredRadiance catmullRomBesideEdge(const Frame& source, const Between& at, Neighbours usable);

/// The plane through the usable samples by moving least squares, at the position: where all are to one side,
/// it goes on as they do instead of repeating the nearest. Clamped to their range. Only usable samples are
/// read, at least one.
[[nodiscard]] LayeredRadiance linearFit(const Frame& source, const Between& at, Neighbours usable);

}  // namespace promenade::ibr
