#pragma once
// Short walks, and the settings to render them with.

#include "paths/camera_path.h"
#include "src/walkthrough/walkthrough.h"

namespace promenade::tests {

inline constexpr Size kWalkSize{64, 36};

/// A camera at rest.
inline paths::CameraPath still(int frames) {
  paths::CameraPath path;
  for (int i = 0; i < frames; ++i) path.frames.push_back({Pose{}, 1.0});
  return path;
}

/// A strafe: `step` metres to the right a frame.
inline paths::CameraPath strafe(int frames, double step) {
  paths::CameraPath path = still(frames);
  for (int i = 0; i < frames; ++i) path.frames[static_cast<std::size_t>(i)].pose.eye.x = i * step;
  return path;
}

/// All frames of the path, shown as they are.
inline walkthrough::Settings settingsFor(const paths::CameraPath& path, Size size = kWalkSize,
                                         int supersample = 2) {
  walkthrough::Settings settings;
  settings.size = size;
  settings.supersample = supersample;
  settings.frames = {0, path.frameCount() - 1};
  settings.tone.curve = ToneCurve::kLinear;
  return settings;
}

}  // namespace promenade::tests
