#pragma once
// How fast an image moves over the retina of an eye that follows it, and which part of that each channel
// sees. Daly 1998: the eye follows at 82 % of the target's speed, up to 80 degrees per second, and never
// rests below 0.15.

#include <glm/vec2.hpp>

namespace promenade::aqm {

/// Velocities in degrees per second. The eye's speed min(0.82 v + 0.15, 80) is taken off along the direction
/// of motion (the result may point backwards: only the magnitude of what follows matters).
[[nodiscard]] glm::dvec2 retinalVelocity(glm::dvec2 imageVelocity);

/// The speed that a channel of the given orientation (0..5) sees: that of the motion across its bars. For
/// kUnoriented, the baseband, that of the whole motion. At least 0.15.
[[nodiscard]] double channelSpeed(glm::dvec2 retinal, int orientation);

}  // namespace promenade::aqm
