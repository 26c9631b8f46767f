#pragma once
// The speed that the channels of each orientation see at every pixel, as positions in the tables of
// SpeedTerms.

#include <cstdint>
#include <vector>

#include "aqm/plane.h"
#include "aqm/settings.h"
#include "aqm/speed_field.h"
#include "aqm/speed_terms.h"

namespace promenade::aqm {

struct SpeedSteps {
  SpeedLevels levels;
  /// The levels between which all speeds lie, inclusive.
  int first = 0;
  int last = 0;
  /// The fastest on the retina, degrees per second, to a step.
  double fastest = 0.0;
  /// One plane per orientation, then one for the baseband (with one orientation: the baseband's only): step
  /// numbers, kSpeedSteps an octave from the slowest speed. Empty where nothing moves: all are 0.
  std::vector<Plane<std::uint16_t>> planes;

  [[nodiscard]] const Plane<std::uint16_t>* of(int orientation) const {
    if (planes.empty()) {
      return nullptr;
    }
    return orientation == kUnoriented ? &planes.back() : &planes[static_cast<std::size_t>(orientation)];
  }
};

/// `velocity`: of the image, degrees per second, of size `image`, or empty if nothing moves.
[[nodiscard]] SpeedSteps speedSteps(const VelocityMap& velocity, int orientations, Eye eye);

}  // namespace promenade::aqm
