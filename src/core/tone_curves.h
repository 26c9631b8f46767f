#pragma once
// Tone curves that know of no eye: from exposed linear Rec.709, in which 0.18 is middle grey, to a display's
// drive signal, which clips at 1.

#include "src/core/image.h"

namespace promenade {

/// Khronos PBR Neutral tone mapper (Khronos Group, specification of 2024): identity up to 0.8 less the
/// Fresnel offset, highlights compressed, hue kept.
[[nodiscard]] Rgb neutralCurve(Rgb exposed);

/// AgX (Troy Sobotka), in the polynomial form of Benjamin Wrensch (2023): a filmic curve over 16.5 stops
/// whose bright colours run to white.
[[nodiscard]] Rgb agxCurve(const Rgb& exposed);

/// Schlick 1994, Quantization techniques for visualization of high dynamic range pictures, eq. 3:
/// p v / (p v - v + 1), rational, from 0 to 0 and from 1 to 1, with the slope p at black.
[[nodiscard]] double schlickCurve(double value, double p);

/// Schlick's curve of the luminance, hue kept. Schlick takes white from the picture's brightest pixel and p
/// from the darkest grey of the display; one for a whole walk is needed: white is 16 (4 stops above the
/// white of a matt surface), and p keeps middle grey where it is.
[[nodiscard]] Rgb schlick(const Rgb& exposed);

/// The colour with another luminance; black stays black.
[[nodiscard]] Rgb withLuminance(const Rgb& colour, double wanted);

}  // namespace promenade
