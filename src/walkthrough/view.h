#pragma once
// Where the camera of a frame of the walk stands, and how fast what it sees moves.

#include "paths/camera_path.h"
#include "src/walkthrough/walkthrough.h"

namespace promenade::walkthrough {

/// At display resolution, sample positions in the middle of pixels.
[[nodiscard]] Camera displayCamera(const paths::CameraPath& path, const Settings& settings, int frame);

/// The camera that the samples of the frame are traced with: with Settings::antialiasing at other places
/// within their cells in every frame.
[[nodiscard]] Camera sampleCamera(const paths::CameraPath& path, const Settings& settings, int frame);

/// Displacement of what `pixels`, seen by the frame at display resolution, shows, until frame `to`. Empty if
/// the path has no such frame.
[[nodiscard]] PixelFlow flowTo(const paths::CameraPath& path, const Settings& settings,
                               const Visibility& pixels, int to);

/// Image velocity of the frame, for the metric.
[[nodiscard]] VelocityMap velocityOf(const paths::CameraPath& path, const Settings& settings,
                                     const Visibility& pixels, int frame);

}  // namespace promenade::walkthrough
