#pragma once
// Local contrast: what a band's response is relative to where the image is brighter or darker than on average
// (Daly 1993, section 5: the baseband of the retina's response at the pixel instead of its mean).

#include "aqm/fourier.h"
#include "aqm/layout.h"
#include "aqm/plane.h"
#include "aqm/spectrum.h"

namespace promenade::aqm {

/// The baseband of the retina's response R, relative to R(`adaptation`): 1 in a uniform field of that
/// luminance. At least 0.1. `spectrum` is that of the frame's contrast, C = (R - Rm) / (Lm R'(Lm)); so R / Rm
/// = 1
/// + 0.37 (1 - Rm) C.
[[nodiscard]] Plane<float> localMeans(const Spectrum& spectrum, const Layout& layout,
                                      const FourierPlans& plans, double adaptation);

}  // namespace promenade::aqm
