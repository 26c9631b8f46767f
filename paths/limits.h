#pragma once
// What no sensible walk exceeds. Beyond it the input is refused before memory is taken for it.

#include <string>

namespace promenade::paths {

inline constexpr double kDefaultFramesPerSecond = 25.0;
inline constexpr double kDefaultVerticalFieldOfViewDegrees = 55.0;
inline constexpr double kMaxFramesPerSecond = 10'000.0;
inline constexpr double kMaxFrames = 1'000'000.0;  ///< 11 hours at 25 frames/s; about 100 MB of poses
inline constexpr double kMaxCoordinateMetres = 1e9;
inline constexpr double kMaxTimeSeconds = 1e9;

/// Frames of a key-framed walk of `durationSeconds` >= 0: frame i is at i / framesPerSecond, in the half-open
/// interval [0, duration), so that 8 s at 25 frames/s are 200 frames and walks can be joined without a
/// doubled frame. At least 1. Throws InputError, beginning with `where`, above kMaxFrames.
[[nodiscard]] int frameCountOf(double durationSeconds, double framesPerSecond, const std::string& where);

/// Returns it if it is in (0, kMaxFramesPerSecond]; else throws InputError.
[[nodiscard]] double checkedFramesPerSecond(double framesPerSecond, const std::string& where);

}  // namespace promenade::paths
