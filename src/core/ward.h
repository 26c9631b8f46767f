#pragma once
// Equal visibility: a difference that is just visible in the world is just visible on the display. Ward 1994,
// A contrast-based scalefactor for luminance display; McNamara, Chalmers, Troscianko 2000, section 3.3.1.

namespace promenade {

/// The least visible difference, cd/m2, for an eye adapted to `adaptation` cd/m2: 0.0594 (1.219 + La^0.4)^2.5
/// (Blackwell's measurements as Ward fits them).
[[nodiscard]] double wardThreshold(double adaptation);

/// cd/m2 on the display for 1 cd/m2 in the world: the quotient of the two thresholds.
[[nodiscard]] double wardScale(double worldAdaptation, double displayAdaptation);

}  // namespace promenade
