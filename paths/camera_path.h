#pragma once
// A walk: one camera pose a frame.

#include <string>
#include <vector>

#include "src/core/camera.h"

namespace promenade::paths {

struct PathFrame {
  Pose pose;
  double verticalFieldOfView;  ///< radians
};

/// Poses at a fixed frame rate; frame i is at i / framesPerSecond seconds. At least one frame.
struct CameraPath {
  std::string name;
  double framesPerSecond = 25.0;
  std::vector<PathFrame> frames;

  [[nodiscard]] int frameCount() const { return static_cast<int>(frames.size()); }
  [[nodiscard]] Camera camera(int frame, Size size) const {
    const PathFrame& f = frames[static_cast<std::size_t>(frame)];
    return Camera(f.pose, f.verticalFieldOfView, size);
  }
};

}  // namespace promenade::paths
