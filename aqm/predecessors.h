#pragma once
// Simple measures of the difference between two frames, one number each, for comparison: the root mean square
// error and three perceptual distances of Rushmeier, Ward, Piatko, Sanders, Rust 1995. None knows of masking,
// of place, or of motion. Two frames of one size, luminance in cd/m2, > 0; otherwise InputError.

#include "src/core/image.h"

namespace promenade::aqm {

/// cd/m2.
[[nodiscard]] double rmse(const LuminanceMap& test, const LuminanceMap& reference);

/// 20 log10(peak / rmse), decibels; infinite for equal frames. `peakLuminance` > 0: of the display, cd/m2.
[[nodiscard]] double psnr(const LuminanceMap& test, const LuminanceMap& reference, double peakLuminance);

/// Model 1, after Mannos and Sakrison: cube root of the luminance over its mean; mean squared difference of
/// the MAGNITUDES of the Fourier coefficients, weighted with their CSF (peak 1). Blind to position.
[[nodiscard]] double rushmeierModel1(const LuminanceMap& test, const LuminanceMap& reference,
                                     double pixelsPerDegree);

/// Model 2, after Gervais et al. 1984: luminance over its mean; root of the mean squared distance of the
/// Fourier coefficients, magnitude and phase (A1^2 + A2^2 - 2 A1 A2 cos(phase difference)), weighted with an
/// anisotropic CSF. Departure: their spline fit of that CSF is not published; Daly's, which has the oblique
/// effect, stands in for it (peak about 1, 100 cd/m2, 0.5 m).
[[nodiscard]] double rushmeierModel2(const LuminanceMap& test, const LuminanceMap& reference,
                                     double pixelsPerDegree);

/// Model 3, after Daly: each pixel's cone response L / (L + 12.6 L^0.63); mean squared difference of the
/// magnitudes, weighted with Daly's CSF at 50 cd/m2 (peak about 1).
[[nodiscard]] double rushmeierModel3(const LuminanceMap& test, const LuminanceMap& reference,
                                     double pixelsPerDegree);

}  // namespace promenade::aqm
