#pragma once
// The speed that the channels of one orientation see at every pixel, in the terms in which their CSF is
// interpolated.

#include <cstdint>
#include <vector>

#include "aqm/cortex.h"
#include "aqm/plane.h"
#include "aqm/settings.h"
#include "src/core/image.h"

namespace promenade::aqm {

/// The CSF's shape inside a band is applied at speed levels an octave apart, from the slowest speed to 1229
/// degrees per second. Above that nothing is seen anyway; faster speeds count as that.
struct SpeedLevels {
  double slowest = 0.15;  ///< of level 0, degrees per second
  int last = 13;

  [[nodiscard]] double speed(int level) const;
};

/// u_j = 0.15 * 2^j, j = 0 .. 13, and as many more below as a stabilised eye needs.
[[nodiscard]] SpeedLevels speedLevels(Eye eye);

/// Planes of the image's size. Columns beyond its width hold finite values, and 0 in `gain`.
struct SpeedField {
  SpeedLevels steps;
  Plane<float> speed;   ///< v, degrees per second, from steps.slowest
  Plane<float> octave;  ///< log2(v / slowest), 0 .. steps.last; level j weighs max(0, 1 - |octave - j|)
  Plane<float> gain;    ///< speedGain(v)
  /// Bit j of element y: level j has a weight above 0 somewhere in row y.
  std::vector<std::uint32_t> levelsOfRow;
  /// Bit j: some row needs level j.
  std::uint32_t levels = 0;
};

/// retinalVelocity() at every pixel; empty if `imageVelocity` is.
[[nodiscard]] VelocityMap retinalVelocities(const VelocityMap& imageVelocity, Eye eye = Eye::kTracking);

/// `retinal`: degrees per second, of size `image`, or empty if nothing moves. `orientation`: 0 .. n-1 of n,
/// or kUnoriented. `onset` >= 0, degrees per second, adds to every speed in quadrature (onsetSpeed()).
[[nodiscard]] SpeedField speedField(const VelocityMap& retinal, Size image, int orientation,
                                    int orientations = kOrientations, Eye eye = Eye::kTracking,
                                    double onset = 0.0);

}  // namespace promenade::aqm
