#pragma once
// The settings of the metric that `promenade compare` uses: a preset, amended by what was typed.

#include <string>
#include <utility>
#include <vector>

#include "aqm/settings.h"
#include "src/app/compare_report.h"
#include "src/app/options.h"

namespace promenade::app {

/// "tracking", "fixating" or "stabilised"; throws InputError otherwise.
[[nodiscard]] aqm::Eye eyeFrom(const std::string& name);

struct Viewer {
  double pixelsPerDegree = 0.0;
  double distanceMetres = 0.0;
  aqm::Eye eye = aqm::Eye::kTracking;
};

/// Of a metric of visibility, amended by `choices`. Throws InputError for a choice that is none.
[[nodiscard]] aqm::Settings settingsOf(Metric metric, const Viewer& viewer, const PipelineOptions& choices);

/// The choices that were made, as (option, value).
[[nodiscard]] std::vector<std::pair<std::string, std::string>> made(const PipelineOptions& choices);

/// The answer depends on the image velocity.
[[nodiscard]] bool knowsOfMotion(const aqm::Settings& settings);

}  // namespace promenade::app
