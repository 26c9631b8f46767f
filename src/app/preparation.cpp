#include "src/app/preparation.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "src/app/fingerprint.h"
#include "src/app/interrupt.h"
#include "src/app/job_record.h"
#include "src/app/solved_light.h"
#include "src/core/errors.h"
#include "src/io/json.h"
#include "src/render/path_renderer.h"
#include "src/walkthrough/adaptation_json.h"
#include "src/walkthrough/statistics.h"

namespace promenade::app {
namespace {

using Solution = std::shared_ptr<const render::LightSolution>;
using walkthrough::Stopwatch;

constexpr const char* kFileName = "prepared.json";
constexpr const char* kLightRecord = "light.json";

std::string fingerprintOf(const std::string& bytes) {
  Fingerprint f;
  f.add(bytes);
  return f.text();
}

std::filesystem::path lightFile(const LoadedJob& job, const OutputFolder& folder) {
  return job.options.lightSolution.empty() ? folder.file("light-solution.bin")
                                           : std::filesystem::path(job.options.lightSolution);
}

nlohmann::ordered_json toJson(const LightUse& light) {
  const auto& [file, records, recordsAdded, cameras, rays] = light.report;
  return {{"fingerprint", light.fingerprint}, {"file", file},       {"records", records},
          {"records_added", recordsAdded},    {"cameras", cameras}, {"rays", rays}};
}

// Throws nlohmann::json::exception.
LightUse lightFrom(const nlohmann::json& value) {
  return {value.at("fingerprint"),
          {.file = value.at("file"),
           .records = value.at("records"),
           .recordsAdded = value.at("records_added"),
           .cameras = value.at("cameras"),
           .rays = value.at("rays")}};
}

// What making the light cost is written before the light itself: a run that is killed between them leaves a
// report that fits no file, never a file without its report.
SolvedLight solve(const LoadedJob& job, const OutputFolder& folder, int threads, Console& console) {
  LightRequest request{lightFile(job, folder), lightHash(job.options, job.scene), job.values.seed, threads};
  request.made = [&](const walkthrough::LightReport& report, const std::string& bytes) {
    nlohmann::ordered_json root = toJson({fingerprintOf(bytes), report});
    root["job"] = job.hash;
    io::writeJson(folder.file(kLightRecord), root);
  };
  return solveLightOf(job.path, job.settings.size, job.scene, request, console);
}

// With the report of the run that made it, if that was one of this job.
LightUse usedLight(const LoadedJob& job, const OutputFolder& folder, const walkthrough::LightReport& report) {
  const std::string fingerprint =
      fingerprintOf(io::readTextFile(lightFile(job, folder), kMaximumSolutionBytes));
  const auto made = fromRecord(folder.file(kLightRecord), job.hash, lightFrom);
  if (made && made->fingerprint == fingerprint) return *made;
  return {fingerprint, report};
}

// The light that the job began with; made again if its file is gone.
Solution lightAsBefore(const LoadedJob& job, const OutputFolder& folder, const Preparation& choices,
                       int threads, Console& console) {
  const std::filesystem::path file = lightFile(job, folder);
  if (!std::filesystem::exists(file)) (void)solve(job, folder, threads, console);
  Solution solution;
  if (choices.light) {
    const std::string bytes = io::readTextFile(file, kMaximumSolutionBytes);
    if (fingerprintOf(bytes) == choices.light->fingerprint) {
      solution = render::lightSolutionFrom(bytes, lightHash(job.options, job.scene));
    }
  }
  if (!solution) {
    throw InputError(file.string(),
                     "is not the light that this job began with: its frames would not fit together; "
                     "--overwrite begins again");
  }
  return solution;
}

// Frames that are traced whole and filtered together have so many times more samples in a pixel, and what a
// sample averages is not to be softer than these tell apart. (Inbetweens have the textures of two keyframes,
// however many frames look at them.)
float sampleWidthOf(const walkthrough::Settings& settings) {
  if (!settings.antialiasing || settings.method != walkthrough::Method::kFull) return 1.0f;
  const int together =
      std::min({settings.antialiasing->frames(), settings.frames.count(), settings.keyframeSpacing + 1});
  return 1.0f / std::sqrt(static_cast<float>(together));
}

}  // namespace

std::unique_ptr<Renderer> rendererOf(const LoadedJob& job,
                                     std::shared_ptr<const render::LightSolution> solution, int threads) {
  return render::makePathRenderer(
      job.scene, {.pathsPerSample = job.values.pathsPerSample.value_or(render::PathSettings{}.pathsPerSample),
                  .seed = job.values.seed,
                  .threads = threads,
                  .sampleWidth = sampleWidthOf(job.settings),
                  .solution = std::move(solution),
                  .checkpoint = [] { throwIfInterrupted(); }});
}

std::optional<Preparation> preparationIn(const OutputFolder& folder, const std::string& jobHash) {
  const std::filesystem::path file = folder.file(kFileName);
  const auto read = [&](const nlohmann::json& root) -> std::optional<Preparation> {
    const auto adaptation = walkthrough::adaptationFrom(root.at("adaptation"), root.at("fps").get<double>());
    if (!adaptation) return std::nullopt;
    Preparation choices{.light = {},
                        .tone = {.curve = toneFrom(root.at("tone").get<std::string>(), file.string()),
                                 .exposureEv = root.at("exposure_ev"),
                                 .candelasPerUnit = root.at("luminance_unit"),
                                 .adaptation = *adaptation},
                        .secondsIndirect = root.at("seconds_indirect"),
                        .secondsChoosing = root.at("seconds_choosing")};
    if (root.contains("light")) choices.light = lightFrom(root["light"]);
    return choices;
  };
  return fromRecord(file, jobHash, read).value_or(std::nullopt);
}

PreparedJob prepare(const LoadedJob& job, const OutputFolder& folder, int threads, Console& console) {
  const bool solves = job.options.integrator == "walkthrough";
  const std::optional<Preparation> known = preparationIn(folder, job.hash);
  PreparedJob prepared;
  Preparation& choices = prepared.choices;
  if (known) {
    choices = *known;
    choices.tone.view = job.settings.tone.view;
  }
  Solution solution;
  if (solves && known) {
    solution = lightAsBefore(job, folder, *known, threads, console);
  } else if (solves) {
    const Stopwatch watch(choices.secondsIndirect);
    SolvedLight light = solve(job, folder, threads, console);
    solution = std::move(light.solution);
    choices.light = usedLight(job, folder, light.report);
  }
  {
    const Stopwatch watch(prepared.secondsBuilding);
    prepared.renderer = rendererOf(job, solution, threads);
  }
  if (known) return prepared;
  {
    const Stopwatch watch(choices.secondsChoosing);
    choices.tone = toneFor(job.values, job.scene, job.path, *prepared.renderer, job.settings);
  }
  nlohmann::ordered_json root = {{"job", job.hash},
                                 {"tone", nameOf(choices.tone.curve)},
                                 {"exposure_ev", choices.tone.exposureEv},
                                 {"luminance_unit", choices.tone.candelasPerUnit},
                                 {"adaptation", walkthrough::adaptationJson(choices.tone)},
                                 {"fps", job.path.framesPerSecond},
                                 {"seconds_indirect", choices.secondsIndirect},
                                 {"seconds_choosing", choices.secondsChoosing}};
  if (choices.light) root["light"] = toJson(*choices.light);
  io::writeJson(folder.file(kFileName), root);
  return prepared;
}

}  // namespace promenade::app
