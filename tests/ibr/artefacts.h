#pragma once
// Images that can be looked at, in the temporary folder of the tests.

#include <string>

#include "ibr/blend.h"

namespace promenade::ibr::tests {

/// NAME.ppm, radiance 1 as white.
void saveForTheEye(const RadianceMap& image, const std::string& name);

/// Radiance where valid; magenta where occluded, yellow where undersampled, blue outside.
[[nodiscard]] RadianceMap paintInvalid(const Warped& warped);
/// Radiance, holes in magenta.
[[nodiscard]] RadianceMap paintHoles(const Blended& blended);
/// 0.5 + gain (a - b).
[[nodiscard]] RadianceMap difference(const RadianceMap& a, const RadianceMap& b, float gain);

}  // namespace promenade::ibr::tests
