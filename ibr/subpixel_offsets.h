#pragma once
// Where in its cell each sample of a frame lies: another place in every frame, so that frames together see
// what lies between the samples of each.

#include <glm/vec2.hpp>

namespace promenade::ibr {

/// Camera::subpixelOffset() of the samples of frame `frame` (any integer), within (-0.5, 0.5) along x and y.
/// Any `period` (odd, >= 1) frames in a row have the points of one lattice of rank 1 (Korobov 1959) in some
/// order: `period` different x and y at equal distances, as far apart as such a lattice allows. So the same
/// points stand behind every filtered frame of a camera at rest. Steps from frame to frame differ, so that no
/// motion of the camera undoes them all.
[[nodiscard]] glm::dvec2 subpixelOffset(int frame, int period);

}  // namespace promenade::ibr
