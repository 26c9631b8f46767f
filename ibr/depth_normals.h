#pragma once
// Geometric normals of a depth map, for frames whose renderer gives none.

#include "src/core/camera.h"
#include "src/core/image.h"

namespace promenade::ibr {

/// Unit normals in world space that face the eye, from the neighbours of each sample: on each axis that
/// neighbour whose depth continues the surface better, so that no normal is taken across a depth edge
/// unless a surface is one sample wide (then it faces the eye). 0 where nothing is hit (depth infinite).
/// Precondition (asserted): `depth` has the camera's size.
[[nodiscard]] NormalMap normalsOf(const DepthMap& depth, const Camera& camera);

}  // namespace promenade::ibr
