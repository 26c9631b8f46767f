#pragma once
// How far and how fast a walk goes.

#include <vector>

#include "paths/camera_path.h"

namespace promenade::paths {

struct Statistics {
  int frames = 0;
  double framesPerSecond = 0.0;
  double durationSeconds = 0.0;  ///< frames / framesPerSecond
  double lengthMetres = 0.0;
  double meanSpeed = 0.0;  ///< metres per second, between neighbouring frames; 0 for a single frame
  double maxSpeed = 0.0;
  double meanTurnRate = 0.0;  ///< degrees per second
  double maxTurnRate = 0.0;
  double minVerticalFieldOfView = 0.0;  ///< degrees
  double maxVerticalFieldOfView = 0.0;
};

/// Speed (metres per second) from each frame to the next: frames - 1 values.
[[nodiscard]] std::vector<double> speeds(const CameraPath& path);
/// Turn rate (degrees per second) from each frame to the next: frames - 1 values.
[[nodiscard]] std::vector<double> turnRates(const CameraPath& path);
[[nodiscard]] Statistics statisticsOf(const CameraPath& path);

}  // namespace promenade::paths
