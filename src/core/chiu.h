#pragma once
// Every place is scaled by what surrounds it. Chiu, Herf, Shirley, Swamy, Wang, Zimmerman 1993, Spatially
// nonuniform scaling functions for high contrast images; McNamara, Chalmers, Troscianko 2000, section 3.3.2.

#include <glm/vec2.hpp>
#include <span>

#include "src/core/image.h"

namespace promenade {

/// What the pictures that are seen at one instant are scaled by. Two pictures that are compared have one.
class Surroundings {
 public:
  /// Nothing is scaled.
  Surroundings() = default;

  /// s = 0.18 / (blurred luminance), so that surroundings are middle grey, of the mean of pictures of one
  /// size whose radiance times `exposure` has middle grey at 0.18. Not so where that would lift surroundings
  /// darker than 4 stops below middle grey to it, nor where it would bring a place above white: there the
  /// scale is lowered, and smoothed again. The order of the pictures changes nothing.
  Surroundings(std::span<const RadianceMap* const> pictures, float exposure);

  /// At a point of the picture in its pixels, whose centres are at + 0.5.
  [[nodiscard]] float scaleAt(glm::vec2 point) const;

 private:
  Image<float> scale_;  // of cells, from edge to edge of the picture
  glm::vec2 cellsPerPixel_{0.0f};
};

}  // namespace promenade
