#pragma once
// Patterns, as contrast around a mean luminance.

#include <filesystem>
#include <functional>
#include <vector>

#include "src/core/image.h"

namespace promenade::validation {

/// Contrast at a place in degrees (right, down) from the centre.
using Pattern = std::function<double(double x, double y)>;

/// Cosine of `cyclesPerDegree` whose bars are perpendicular to `degrees` (0: vertical bars), under a Gaussian
/// window of standard deviations `sx`, `sy`.
[[nodiscard]] Pattern gabor(double cyclesPerDegree, double degrees, double sx, double sy);
[[nodiscard]] Pattern grating(double cyclesPerDegree, double degrees);

/// `luminance` (1 + contrast pattern), the centre of gaze at pixel (width/2, height/2); at least 1e-3 of the
/// mean.
[[nodiscard]] LuminanceMap frameOf(Size size, double pixelsPerDegree, double luminance, double contrast,
                                   const Pattern& pattern);

/// A sum of what several contrast rasters hold, on one mean.
using Raster = std::vector<double>;
[[nodiscard]] LuminanceMap frameOf(Size size, double luminance, const Raster& contrast);
[[nodiscard]] Raster rasterOf(Size size, double pixelsPerDegree, const Pattern& pattern);

/// Noise whose amplitude at each frequency is exactly `amplitude`(cycles per degree, degrees of direction),
/// phases random, of root mean square `rms`. Square, `side` pixels, periodic.
[[nodiscard]] Raster noise(int side, double pixelsPerDegree, double rms, unsigned seed,
                           const std::function<double(double, double)>& amplitude);

/// ModelFest stimulus 1 .. 43 as contrast of peak 1; the two photographs are read from `data`.
[[nodiscard]] Raster modelfest(int stimulus, const std::filesystem::path& data);
inline constexpr Size kModelfestSize{256, 256};
inline constexpr double kModelfestPpd = 120.0;

/// Frames of Daly's tests: five degrees wide.
inline constexpr Size kDalySize{200, 200};
inline constexpr double kDalyPpd = 40.0;

}  // namespace promenade::validation
