#pragma once
// The colours of a display's three lights.

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

namespace promenade {

/// CIE 1931 chromaticities x, y. The default: ITU-R BT.709-6 (the same as IEC 61966-2-1, sRGB).
struct Primaries {
  glm::dvec2 red{0.64, 0.33};
  glm::dvec2 green{0.30, 0.60};
  glm::dvec2 blue{0.15, 0.06};
  glm::dvec2 white{0.3127, 0.3290};
  friend bool operator==(const Primaries&, const Primaries&) = default;
};

/// Whether every y is above 0, the three lights span a triangle and white lies inside of it, so that each of
/// them shines in white.
[[nodiscard]] bool arePossible(const Primaries& primaries);

/// XYZ (white has Y = 1) of linear RGB: the lights in the proportions that give white (SMPTE RP 177-1993).
/// Precondition: arePossible(primaries).
[[nodiscard]] glm::dmat3 xyzFromRgb(const Primaries& primaries);

/// The linear RGB of a display that looks like linear Rec.709, to an eye that has adapted from white D65 to
/// the display's white (von Kries with the Bradford cone responses; ICC.1:2022, annex E). White stays (1, 1,
/// 1). Precondition: arePossible(primaries).
[[nodiscard]] glm::dmat3 rgbFromRec709(const Primaries& primaries);

}  // namespace promenade
