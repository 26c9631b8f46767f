#pragma once
// The tone mapping of frames that are already rendered: as the report beside them says, else found in them.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>

#include "src/app/values.h"
#include "src/core/tone_mapping.h"
#include "src/io/sequence.h"

namespace promenade::app {

struct ChosenTone {
  ToneMapping mapping;
  int firstFrame = 0;  ///< of the walk that the mapping is of: what the first image is there
};

/// One for all sequences; their order changes nothing. What the options leave open is what all of them were
/// rendered with, where they are folders that `promenade render` filled (or the frames in it) and agree; else
/// the exposure is exposureFor() them, the unit follows from the exposure, and the eye adapts to what all of
/// them together show.
[[nodiscard]] ChosenTone chosenTone(const ToneOptions& options, std::span<const io::Sequence> sequences,
                                    double framesPerSecond);

/// The display that a folder's report names.
[[nodiscard]] std::optional<DisplayModel> renderedDisplay(const std::string& argument);

/// The adaptation in the `job` of a report.json; the default where it has none. Throws InputError that names
/// `file` if it is damaged.
[[nodiscard]] AdaptationCurve adaptationFromJson(const nlohmann::json& job, const std::string& file);

}  // namespace promenade::app
