#pragma once
// Luminance -> the contrast that the later stages see: the amplitude nonlinearity of the retina, expanded to
// first order around the mean luminance so that small contrasts keep their value. R(L) = L / (L + 12.6
// L^0.63): Daly 1993, section 3. Global contrast: one adaptation level for the whole image and, departing
// from Daly, for both frames, so that neither frame is the yardstick of the other.

#include "src/core/image.h"

namespace promenade::aqm {

/// Contrast around the adaptation luminance, no unit, finite.
using ContrastMap = Map<struct ContrastTag, float>;

/// R(L), 0 < R < 1, for `luminance` > 0 in cd/m2.
[[nodiscard]] double coneResponse(double luminance);

/// The mean of the two frames' mean luminances, cd/m2. The same bits whichever frame comes first.
[[nodiscard]] double adaptationLuminance(const LuminanceMap& a, const LuminanceMap& b);

/// C = (R(L) - R(Lm)) / (Lm R'(Lm)) with Lm = `adaptation` > 0.
[[nodiscard]] ContrastMap contrast(const LuminanceMap& luminance, double adaptation);

/// The same in single precision, eight pixels at a time: within 2e-6 + 2e-6 C.
[[nodiscard]] ContrastMap fastContrast(const LuminanceMap& luminance, double adaptation);

}  // namespace promenade::aqm
