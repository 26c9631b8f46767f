#pragma once
// The Fourier transform of a contrast image that has been extended by reflection.

#include <complex>

#include "aqm/contrast.h"
#include "aqm/fourier.h"
#include "aqm/layout.h"
#include "aqm/plane.h"

namespace promenade::aqm {

/// Half of the spectrum of a real image of size layout.padded: row ix of the plane is the COLUMN of the
/// spectrum at horizontal frequency ix = 0 .. width/2; element iy of it is vertical frequency number iy = 0
/// .. height-1. Unscaled.
using Spectrum = Plane<std::complex<float>>;

/// The transform of `contrast` (size layout.image). Each frame is transformed by itself: packing two real
/// frames into one complex transform would leak rounding errors from one into the other, and equal frames
/// would no longer differ by exactly 0.
[[nodiscard]] Spectrum spectrumOf(const ContrastMap& contrast, const Layout& layout,
                                  const FourierPlans& plans);

}  // namespace promenade::aqm
