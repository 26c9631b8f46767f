#pragma once
// What the eye adapts to on a walk, as JSON: in report.json, and in the record from which a job is resumed
// (docs/formats.md). Numbers come back exactly.

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "src/core/tone_mapping.h"

namespace promenade::walkthrough {

/// The views, [frame, cd/m2] each, of a tone that asks for histograms [frame, cd/m2, bin, shares]: from the
/// first bin with light to the last. Null where there are none.
[[nodiscard]] nlohmann::ordered_json adaptationJson(const ToneMapping& tone);
/// Nothing if it is not what adaptationJson() makes.
[[nodiscard]] std::optional<AdaptationCurve> adaptationFrom(const nlohmann::json& value,
                                                            double framesPerSecond);

}  // namespace promenade::walkthrough
