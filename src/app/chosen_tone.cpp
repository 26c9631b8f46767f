#include "src/app/chosen_tone.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>
#include <variant>
#include <vector>

#include "src/app/displays.h"
#include "src/app/exposure.h"
#include "src/core/errors.h"
#include "src/io/image_file.h"
#include "src/io/json.h"
#include "src/walkthrough/adaptation_json.h"

namespace promenade::app {
namespace {

using Json = nlohmann::json;

std::filesystem::path reportBeside(const std::string& argument) {
  std::filesystem::path folder(argument);
  if (!folder.has_filename()) folder = folder.parent_path();
  if (folder.filename() == "frames") folder = folder.parent_path();
  return folder / "report.json";
}

// The job in the report beside the frames; null if there is none.
Json jobBeside(const std::string& argument) {
  const std::filesystem::path report = reportBeside(argument);
  if (!std::filesystem::is_regular_file(report)) return {};
  const Json root = io::readJson(report);
  return root.is_object() ? root.value("job", Json()) : Json();
}

// What all jobs have under `key`; null if they do not agree or one has nothing.
Json common(const std::vector<Json>& jobs, const char* key) {
  Json value;
  for (const Json& job : jobs) {
    if (!job.is_object() || !job.contains(key) || job[key].is_null()) return {};
    if (!value.is_null() && value != job[key]) return {};
    value = job[key];
  }
  return value;
}

std::optional<double> commonNumber(const std::vector<Json>& jobs, const char* key) {
  const Json value = common(jobs, key);
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

std::vector<double> lightIn(std::span<const io::Sequence> sequences, std::size_t index) {
  std::vector<double> luminances;
  for (const io::Sequence& sequence : sequences) {
    if (index >= sequence.images.size()) continue;
    const io::ImageFile image = io::readImage(sequence.images[index], sequence.layer);
    if (const auto* radiance = std::get_if<RadianceMap>(&image.colour)) {
      const std::vector<double> parts = fovealLuminances(*radiance);
      luminances.insert(luminances.end(), parts.begin(), parts.end());
    }
  }
  return luminances;
}

AdaptationCurve adaptationTo(std::span<const io::Sequence> sequences, double candelasPerUnit,
                             double framesPerSecond) {
  std::size_t count = 0;
  for (const io::Sequence& sequence : sequences) count = std::max(count, sequence.images.size());
  if (count == 0) return {};
  std::vector<View> views;
  for (const int frame : framesToView(0, static_cast<int>(count) - 1, framesPerSecond)) {
    std::vector<double> luminances = lightIn(sequences, static_cast<std::size_t>(frame));
    if (luminances.empty()) return {};  // of display-encoded frames nothing is mapped
    views.push_back(viewOf(frame, std::move(luminances), candelasPerUnit));
  }
  return {std::move(views), framesPerSecond};
}

}  // namespace

ChosenTone chosenTone(const ToneOptions& options, std::span<const io::Sequence> sequences,
                      double framesPerSecond) {
  std::vector<Json> jobs;
  for (const io::Sequence& sequence : sequences) jobs.push_back(jobBeside(sequence.argument));
  ChosenTone chosen;
  ToneMapping& tone = chosen.mapping;
  tone.curve = options.curve;
  tone.view = options.view;
  tone.exposureEv = 0.0;
  if (const auto stops = options.exposureEv ? options.exposureEv : commonNumber(jobs, "exposure_ev")) {
    tone.exposureEv = *stops;
  } else {
    tone.exposureEv = exposureFor(sequences);
  }
  const auto renderedUnit = commonNumber(jobs, "luminance_unit");
  tone.candelasPerUnit = options.candelasPerUnit               ? *options.candelasPerUnit
                         : renderedUnit && !options.exposureEv ? *renderedUnit
                                                               : candelasFromExposure(tone.exposureEv);
  if (!modelsTheEye(tone.curve)) return chosen;
  const Json first = common(jobs, "first_frame");
  // Of the tones only larson writes histograms.
  const bool isKnown = (tone.curve != ToneCurve::kLarson || common(jobs, "tone") == nameOf(tone.curve)) &&
                       first.is_number_integer() && renderedUnit == tone.candelasPerUnit &&
                       !common(jobs, "adaptation").is_null() && !common(jobs, "fps").is_null();
  if (isKnown) {
    chosen.firstFrame = first.get<int>();
    tone.adaptation = adaptationFromJson(jobs.front(), reportBeside(sequences.front().argument).string());
  } else {
    tone.adaptation = adaptationTo(sequences, tone.candelasPerUnit, framesPerSecond);
  }
  return chosen;
}

std::optional<DisplayModel> renderedDisplay(const std::string& argument) {
  const Json job = jobBeside(argument);
  if (!job.is_object() || !job.contains("display_model")) return std::nullopt;
  return displayFromJson(job["display_model"].dump(), reportBeside(argument).string());
}

AdaptationCurve adaptationFromJson(const Json& job, const std::string& file) {
  const Json fps = job.value("fps", Json());
  const auto curve =
      walkthrough::adaptationFrom(job.value("adaptation", Json()), fps.is_number() ? fps.get<double>() : 0.0);
  if (!curve) {
    throw InputError(file, "job.adaptation: expected [frame, cd/m2] or [frame, cd/m2, bin, shares] in order");
  }
  return *curve;
}

}  // namespace promenade::app
