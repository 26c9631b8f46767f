#pragma once
// From samples to display pixels: the last step before output, and what the metric looks at.

#include "src/core/frame.h"

namespace promenade {

/// Averages the `factor` x `factor` samples of each pixel, in linear radiance: a box over the pixel.
/// Precondition: the sample image is a multiple of `factor` in both directions.
[[nodiscard]] RadianceMap resolveRadiance(const RadianceMap& samples, int factor);

/// Depth, normal, item of a display pixel: those of the sample nearest to its centre that is closest to the
/// eye, so that no value is ever a mix of two surfaces.
[[nodiscard]] Visibility resolveVisibility(const Visibility& samples, int factor);

/// The most frequent source of the pixel's samples (ties: the larger enum value, i.e. the more traced one).
[[nodiscard]] SourceMap resolveSource(const SourceMap& samples, int factor);

}  // namespace promenade
