#pragma once
// Pairs of rendered frames as the planner hands them to the metric: two keyframes of a walk, ray traced, both
// warped to the frame in their middle, with the pixel flow there.

#include "aqm/metric.h"
#include "paths/camera_path.h"
#include "src/core/display.h"
#include "src/scene/scene.h"

namespace promenade::tests {

struct FramePair {
  LuminanceMap test;       ///< warped from the first keyframe
  LuminanceMap reference;  ///< warped from the last
  VelocityMap velocity;    ///< of the image in the middle, degrees per second
};

struct Rendering {
  Size size{256, 144};  ///< display pixels
  int supersample = 1;
  int paths = 8;         ///< of a sample
  DisplayModel display;  ///< its pixels per degree also turn the flow into a velocity
};

/// Keyframes `first` and `last` of the walk (at least two frames apart, neither of them its end) and the
/// frame between them. Exposed automatically.
[[nodiscard]] FramePair warpedPair(const Scene& scene, const paths::CameraPath& walk, int first, int last,
                                   const Rendering& rendering);

/// The scene's camera animation.
[[nodiscard]] paths::CameraPath walkOf(const Scene& scene);

}  // namespace promenade::tests
