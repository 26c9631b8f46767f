#pragma once
// Camera paths from text. World coordinates are kept as they stand in the file; only the camera's own axes
// are converted to Promenade's (x right, y up, looks along -z).

#include <optional>
#include <string>

#include "paths/camera_path.h"
#include "paths/keyframes.h"

namespace promenade::paths {

struct ReadOptions {
  /// Frame rate of the result; absent: the file's own, or 25 if it has none.
  std::optional<double> framesPerSecond;
};

/// Promenade's own JSON (docs/formats.md). Unknown keys are errors. `where` (a file name) begins every
/// message.
[[nodiscard]] Keyframes parseKeyframes(const std::string& text, const std::string& where);

/// nerfstudio's camera_path.json: one camera a frame ("camera_to_world", 16 numbers row by row, x right, y
/// up, looks along -z; "fov" vertical in degrees) and "fps" (24 if absent, as there). Scaled axes are
/// normalised.
[[nodiscard]] CameraPath parseNerfstudio(const std::string& text, const std::string& where);

/// A TUM trajectory: lines "timestamp tx ty tz qx qy qz qw" (seconds, metres, worldFromCamera), '#' comments.
/// Its cameras are those of computer vision (x right, y down, looks along +z). The poses are samples, so both
/// ends belong to the walk: floor(duration * fps) + 1 frames. It has no field of view; 55 degrees are taken.
[[nodiscard]] CameraPath parseTum(const std::string& text, const std::string& where,
                                  const ReadOptions& options);

/// The format is told by the content: JSON with "camera_path" is nerfstudio's, other JSON Promenade's,
/// everything else TUM. Every error is an InputError that begins with `where`.
[[nodiscard]] CameraPath parsePath(const std::string& text, const std::string& where,
                                   const ReadOptions& options);

/// The same walk at another frame rate: round(duration * fps) frames, at least 1, positions linearly and
/// rotations spherically interpolated, the last frame held.
[[nodiscard]] CameraPath resampled(const CameraPath& path, double framesPerSecond, const std::string& where);

}  // namespace promenade::paths
