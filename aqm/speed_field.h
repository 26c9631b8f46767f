#pragma once
// The speed that the channels of one orientation see at every pixel, in the terms in which their CSF is
// interpolated.

#include <cstdint>
#include <vector>

#include "aqm/plane.h"
#include "src/core/image.h"

namespace promenade::aqm {

/// The CSF's shape inside a band is applied at the octave speed levels u_j = 0.15 * 2^j degrees per second, j
/// = 0 .. 13. Above the last (1229 degrees per second on the retina) nothing is seen anyway; faster speeds
/// count as that.
inline constexpr int kFastestLevel = 13;
[[nodiscard]] double levelSpeed(int level);

/// Planes of the image's size. Columns beyond its width hold finite values, and 0 in `gain`.
struct SpeedField {
  Plane<float> speed;   ///< v, degrees per second, from 0.15
  Plane<float> octave;  ///< log2(v / 0.15), 0 .. kFastestLevel; level j weighs max(0, 1 - |octave - j|)
  Plane<float> gain;    ///< speedGain(v)
  /// Bit j of element y: level j has a weight above 0 somewhere in row y.
  std::vector<std::uint32_t> levelsOfRow;
  /// Bit j: some row needs level j.
  std::uint32_t levels = 0;
};

/// retinalVelocity() at every pixel; empty if `imageVelocity` is.
[[nodiscard]] VelocityMap retinalVelocities(const VelocityMap& imageVelocity);

/// `retinal`: degrees per second, of size `image`, or empty if nothing moves. `orientation`: 0..5 or
/// kUnoriented.
[[nodiscard]] SpeedField speedField(const VelocityMap& retinal, Size image, int orientation);

}  // namespace promenade::aqm
