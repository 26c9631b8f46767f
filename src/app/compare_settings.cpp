#include "src/app/compare_settings.h"

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <span>
#include <string_view>

#include "src/app/values.h"

namespace promenade::app {
namespace {

/// Of the Laplacian pyramid, unless --orientations says otherwise.
constexpr int kPyramidOrientations = 4;

// The value that goes with one of the names.
template <class Value>
Value chosen(const std::string& name, const char* option,
             std::initializer_list<std::pair<std::string_view, Value>> values) {
  std::vector<std::string_view> names;
  for (const auto& [known, value] : values) names.push_back(known);
  const std::string found = choiceFrom(name, std::span<const std::string_view>(names), option);
  return std::ranges::find(values, std::string_view(found), [](const auto& entry) { return entry.first; })
      ->second;
}

}  // namespace

aqm::Eye eyeFrom(const std::string& name) {
  const std::string chosen = choiceFrom(name, {"tracking", "fixating", "stabilised"}, "--eye");
  return chosen == "fixating"     ? aqm::Eye::kFixating
         : chosen == "stabilised" ? aqm::Eye::kStabilised
                                  : aqm::Eye::kTracking;
}

aqm::Settings settingsOf(Metric metric, const Viewer& viewer, const PipelineOptions& choices) {
  using namespace aqm;
  const double ppd = viewer.pixelsPerDegree;
  Settings settings = metric == Metric::kAqm2000   ? aqm2000(ppd)
                      : metric == Metric::kRevised ? revisedAqm(ppd)
                      : metric == Metric::kVdp     ? vdp(ppd, viewer.distanceMetres)
                                                   : aqm::aqm(ppd);
  settings.eye = viewer.eye;
  if (viewer.eye == Eye::kStabilised) settings.onsetHertz = 0.0;  // no glances either
  if (const auto& text = choices.contrast; !text.empty()) {
    settings.contrast = chosen<ContrastKind>(
        text, "--contrast", {{"global", ContrastKind::kGlobal}, {"local", ContrastKind::kLocal}});
  }
  if (const auto& text = choices.filters; !text.empty()) {
    settings.decomposition = chosen<Decomposition>(text, "--filters",
                                                   {{"energy", Decomposition::kCortexEnergy},
                                                    {"amplitude", Decomposition::kCortexAmplitude},
                                                    {"laplacian", Decomposition::kLaplacianPyramid}});
    if (settings.decomposition == Decomposition::kLaplacianPyramid)
      settings.orientations = kPyramidOrientations;
  }
  if (const auto& text = choices.bands; !text.empty()) {
    settings.radialBands = integerFrom(text, kFewestRadialBands, kMostRadialBands, "--bands");
  }
  if (const auto& text = choices.orientations; !text.empty()) {
    settings.orientations = integerFrom(text, 1, kMostOrientations, "--orientations");
  }
  if (const auto& text = choices.csf; !text.empty()) {
    settings.csf = chosen<Csf>(text, "--csf",
                               {{"kelly", Csf::kKellyDaly},
                                {"moving", Csf::kDalyMoving},
                                {"daly", Csf::kDaly},
                                {"mannos", Csf::kMannosSakrison}});
    settings.viewingDistanceMetres = viewer.distanceMetres;
  }
  if (const auto& text = choices.csfAt; !text.empty()) {
    settings.csfPlacement = chosen<CsfPlacement>(
        text, "--csf-at", {{"bands", CsfPlacement::kWithinBands}, {"centres", CsfPlacement::kBandCentres}});
  }
  if (!choices.onset.empty())
    settings.onsetHertz = numberFrom(choices.onset, 0.0, kMostOnsetHertz, "--onset");
  if (const auto& text = choices.elevation; !text.empty()) {
    settings.masking.elevation =
        chosen<Elevation>(text, "--elevation", {{"unit", Elevation::kUnitKnee}, {"daly", Elevation::kDaly}});
  }
  if (const auto& text = choices.masking; !text.empty()) {
    const auto source = chosen<std::optional<MaskSource>>(text, "--masking",
                                                          {{"mutual", MaskSource::kMutual},
                                                           {"test", MaskSource::kTest},
                                                           {"reference", MaskSource::kReference},
                                                           {"none", std::nullopt}});
    if (source) settings.masking.source = *source;
    if (!source) settings.masking.elevation = Elevation::kNone;
  }
  if (const auto& text = choices.pooling; !text.empty()) {
    settings.pooling =
        chosen<Pooling>(text, "--pooling", {{"half-degree", Pooling::kHalfDegree}, {"none", Pooling::kNone}});
  }
  if (!choices.gain.empty()) settings.gain = numberFrom(choices.gain, 0.001, 1000.0, "--gain");
  return settings;
}

std::vector<std::pair<std::string, std::string>> made(const PipelineOptions& choices) {
  std::vector<std::pair<std::string, std::string>> result;
  const std::pair<const char*, const std::string&> all[] = {{"contrast", choices.contrast},
                                                            {"filters", choices.filters},
                                                            {"bands", choices.bands},
                                                            {"orientations", choices.orientations},
                                                            {"csf", choices.csf},
                                                            {"csf-at", choices.csfAt},
                                                            {"onset", choices.onset},
                                                            {"masking", choices.masking},
                                                            {"elevation", choices.elevation},
                                                            {"pooling", choices.pooling},
                                                            {"gain", choices.gain}};
  for (const auto& [name, value] : all) {
    if (!value.empty()) result.emplace_back(name, value);
  }
  return result;
}

bool knowsOfMotion(const aqm::Settings& settings) {
  return settings.csf == aqm::Csf::kKellyDaly || settings.csf == aqm::Csf::kDalyMoving;
}

}  // namespace promenade::app
