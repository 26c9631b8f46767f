#pragma once
// How fast an image moves over the retina of an eye that follows it, and which part of that each channel
// sees. Daly 1998: the eye follows at 82 % of the target's speed, up to 80 degrees per second, and never
// rests below 0.15.

#include <glm/vec2.hpp>

#include "aqm/settings.h"

namespace promenade::aqm {

/// The slowest that anything moves over the retina, degrees per second > 0: the drift of 0.15, or, where not
/// even that is left (kStabilised), a sixteenth of it: a grating of 4 cycles per degree then needs 2.2 times
/// the contrast, and Kelly's formula is not measured further down.
[[nodiscard]] double slowestSpeed(Eye eye);

/// Velocities in degrees per second. A tracking eye's speed min(0.82 v + 0.15, 80) is taken off along the
/// direction of motion (the result may point backwards: only the magnitude of what follows matters).
[[nodiscard]] glm::dvec2 retinalVelocity(glm::dvec2 imageVelocity, Eye eye = Eye::kTracking);

/// The speed that a channel of the given direction (across its bars, a unit vector) sees: that of the motion
/// along this direction. At least `slowest`.
[[nodiscard]] double channelSpeed(glm::dvec2 retinal, glm::dvec2 across, double slowest);
/// For a channel without orientation: that of the whole motion.
[[nodiscard]] double channelSpeed(glm::dvec2 retinal, double slowest);

/// The speed at which a grating of `cyclesPerDegree` > 0 passes `onsetHertz` times a second: to the CSF, a
/// pattern that comes and goes and one that moves past are the same temporal frequency (Kelly 1979). Adds to
/// the speed of a channel in quadrature. Degrees per second; 0 for 0 Hz.
[[nodiscard]] double onsetSpeed(double onsetHertz, double cyclesPerDegree);

}  // namespace promenade::aqm
