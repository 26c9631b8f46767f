#pragma once
// Statistics as JSON: in report.json, and in the records from which a job is resumed or put together
// (docs/formats.md). Numbers come back exactly.

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "src/walkthrough/statistics.h"

namespace promenade::walkthrough {

[[nodiscard]] nlohmann::ordered_json toJson(const FrameStatistics& frame);
/// Nothing if it is not what toJson() makes.
[[nodiscard]] std::optional<FrameStatistics> frameStatisticsFrom(const nlohmann::json& value);

/// {"segments": [...], "frames": [...], "seconds": {...}}
[[nodiscard]] nlohmann::ordered_json toJson(const Statistics& statistics);
/// Nothing if it is not what toJson() makes: another version of the program may have written it.
[[nodiscard]] std::optional<Statistics> statisticsFrom(const nlohmann::json& value);

}  // namespace promenade::walkthrough
