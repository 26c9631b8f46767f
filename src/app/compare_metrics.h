#pragma once
// The metrics that `promenade compare` offers, and what each finds between two frames.

#include <string>

#include "aqm/metric.h"
#include "src/app/compare_report.h"
#include "src/core/image.h"

namespace promenade::app {

/// Throws InputError that names the nearest metric.
[[nodiscard]] Metric metricFrom(const std::string& name);

/// "tracking", "fixating" or "stabilised"; throws InputError otherwise.
[[nodiscard]] aqm::Eye eyeFrom(const std::string& name);

/// The metric's answer depends on the image velocity.
[[nodiscard]] bool knowsOfMotion(Metric metric);

struct Viewer {
  double pixelsPerDegree = 0.0;
  double distanceMetres = 0.0;
  aqm::Eye eye = aqm::Eye::kTracking;
};

/// Of a metric of visibility; without any shortcut, because these numbers are published.
[[nodiscard]] aqm::Settings settingsOf(Metric metric, const Viewer& viewer);

/// Summary of the maps.
[[nodiscard]] FrameDifference visibility(const aqm::Result& result);

/// One of Rushmeier's models; cd/m2.
[[nodiscard]] FrameDifference modelDistance(Metric model, const LuminanceMap& test,
                                            const LuminanceMap& reference, double pixelsPerDegree);

/// Root mean square of code values in [0, 1], and the signal to noise ratio with peak 1.
[[nodiscard]] FrameDifference squaredError(const EncodedMap& test, const EncodedMap& reference);
/// The same of luminance relative to the brightest pixel of both frames.
[[nodiscard]] FrameDifference squaredError(const LuminanceMap& test, const LuminanceMap& reference);

}  // namespace promenade::app
