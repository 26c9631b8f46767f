#pragma once
// Where exactly does a surface end between the samples of a frame? Each frame of a walk has samples at other
// places of the surface, and beside it, so frames together tell it more finely than each.

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "ibr/reprojection.h"
#include "ibr/sight.h"
#include "ibr/source_surface.h"
#include "src/core/frame.h"

namespace promenade::ibr {

/// Keeps references to all frames.
class Coverage {
 public:
  /// `creaseDegrees` as in WarpSettings.
  Coverage(const Visibility& frame, std::span<const Visibility* const> others, double creaseDegrees);

  /// Whether the surface of sample (x, y) of the frame, not background, goes on to `place` (pixels of the
  /// frame, about a sample away), so that it hides what is behind it there. Each frame is asked for its
  /// sample that is nearest to where the tangent plane has that place: it shows the surface, or what is
  /// behind it. (What is beside it, a face that hides as much, or in front says nothing.) They count by 1 /
  /// d^2, d being how far from the place their sample is (Shepard 1968): the surface reaches as far as those
  /// that show it outweigh the others. Where none can tell, it goes on.
  [[nodiscard]] bool reaches(int x, int y, glm::vec2 place) const;

 private:
  /// A frame that is asked.
  struct Witness {
    const Visibility* visibility;
    Reprojection reproject;
    Sight sight;
    glm::vec3 eyeShift;  ///< from its eye to that of the frame
  };
  [[nodiscard]] static Witness witness(const Visibility& frame, const Visibility& asked,
                                       double creaseDegrees);

  const Visibility& frame_;
  RayBasis rays_;
  std::vector<Witness> witnesses_;
};

}  // namespace promenade::ibr
