#pragma once
// The metrics that `promenade compare` offers, and what each finds between two frames.

#include <string>

#include "aqm/metric.h"
#include "src/app/compare_report.h"
#include "src/core/image.h"

namespace promenade::app {

/// Throws InputError that names the nearest metric.
[[nodiscard]] Metric metricFrom(const std::string& name);

/// Summary of the maps, over the pixels that `excluded` (of the frames' size, or empty) does not select;
/// there must be one.
[[nodiscard]] FrameDifference visibility(const aqm::Result& result, const Mask& excluded);

/// One of Rushmeier's models; cd/m2.
[[nodiscard]] FrameDifference modelDistance(Metric model, const LuminanceMap& test,
                                            const LuminanceMap& reference, double pixelsPerDegree);

/// Root mean square of code values in [0, 1], and the signal to noise ratio with peak 1; `excluded` as for
/// visibility().
[[nodiscard]] FrameDifference squaredError(const EncodedMap& test, const EncodedMap& reference,
                                           const Mask& excluded);
/// The same of luminance relative to the brightest pixel of both frames.
[[nodiscard]] FrameDifference squaredError(const LuminanceMap& test, const LuminanceMap& reference,
                                           const Mask& excluded);

}  // namespace promenade::app
