#pragma once
// The walk through the hall.

#include <vector>

#include "examples/hall/gltf_writer.h"

namespace promenade::hall {

inline constexpr double kWalkSeconds = 8.0;
inline constexpr double kWalkFramesPerSecond = 25.0;
inline constexpr double kWalkFieldOfViewDegrees = 54.0;  ///< vertical

/// 201 keys, one a frame and one that ends the last of the 200 frames.
[[nodiscard]] std::vector<CameraKey> walkKeys();

}  // namespace promenade::hall
