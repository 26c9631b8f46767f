#pragma once
// Gaussian blur of images.

#include "src/core/image.h"

namespace promenade {

/// Convolved with a Gaussian of `sigma` pixels, cut off at 3 sigma, whose weights outside of the image go to
/// those inside: no light is lost at the edges, and a uniform image stays as it is. Every pixel must be
/// finite.
[[nodiscard]] RadianceMap blurred(const RadianceMap& image, double sigma);

}  // namespace promenade
