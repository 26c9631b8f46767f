#include "src/app/rendered_job.h"

#include <nlohmann/json.hpp>

#include "src/app/chosen_tone.h"
#include "src/app/displays.h"
#include "src/app/formatted.h"
#include "src/core/errors.h"
#include "src/io/exr_frame.h"
#include "src/io/json.h"
#include "src/io/text_file.h"

namespace promenade::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// All that the page of a report reads of its lists, so that it never meets a gap.
void requireLists(const Json& root) {
  for (const Json& segment : root.at("segments")) {
    for (const char* key : {"depth", "difference_percent", "masked_percent"}) {
      (void)segment.at(key).get<double>();
    }
    (void)segment.at("decision").get<std::string>();
  }
  for (const Json& frame : root.at("frames")) {
    for (const char* key : {"index", "samples_traced", "holes", "items_traced", "warped", "seconds"}) {
      (void)frame.at(key).get<double>();
    }
    (void)frame.at("kind").get<std::string>();
  }
  const Json& totals = root.at("totals");
  for (const char* key : {"frames", "keyframes", "samples", "samples_traced", "traced_fraction", "rays",
                          "visibility_rays", "peak_rss_bytes"}) {
    (void)totals.at(key).get<double>();
  }
  for (const auto& [part, seconds] : totals.at("seconds").items()) (void)seconds.get<double>();
  (void)root.at("version").get<std::string>();
}

RenderedJob jobFrom(const Json& root, const std::string& file) {
  requireLists(root);
  RenderedJob r;
  const Json& job = root.at("job");
  r.scene = job.at("scene").get<std::string>();
  r.size = {job.at("size").at(0).get<int>(), job.at("size").at(1).get<int>()};
  r.supersample = job.at("supersample").get<int>();
  r.frames = {job.at("first_frame").get<int>(), job.at("last_frame").get<int>()};
  r.framesPerSecond = job.at("fps").get<double>();
  r.everyFrameTraced = job.at("method").get<std::string>() == "full";
  r.integrator = job.at("integrator").get<std::string>();
  if (const Json& spp = job.at("spp"); !spp.is_null()) r.pathsPerSample = spp.get<int>();
  r.threads = job.at("threads").get<int>();
  r.tone.curve = toneFrom(job.at("tone").get<std::string>(), file + ": job.tone");
  if (r.tone.curve == ToneCurve::kOcio) {
    const Json& view = job.at("ocio");
    r.tone.view = viewFrom({.config = view.at("config"),
                            .display = view.at("display"),
                            .view = view.at("view"),
                            .input = view.at("input")});
  }
  r.tone.exposureEv = job.at("exposure_ev").get<double>();
  r.tone.candelasPerUnit = job.value("luminance_unit", candelasFromExposure(r.tone.exposureEv));
  r.tone.adaptation = adaptationFromJson(job, file);
  r.display = job.contains("display_model") ? displayFromJson(job.at("display_model").dump(), file)
                                            : displayNamed(job.at("display").get<std::string>());
  r.wallSeconds = root.at("totals").at("seconds_wall").get<double>();
  r.speedupEstimated = root.at("totals").value("speedup_estimated", 0.0);
  for (const Json& segment : root.at("segments")) {
    r.segments.push_back(
        {segment.at("first").get<int>(), segment.at("last").get<int>(), segment.at("middle").get<int>()});
  }
  if (r.size.width < 1 || r.size.height < 1 || r.supersample < 1 || r.frames.first < 0 ||
      r.frames.last < r.frames.first || r.frames.last >= 1'000'000 || !(r.framesPerSecond > 0.0)) {
    throw InputError(file, "not a report of Promenade: expected sizes and frame numbers that make sense");
  }
  return r;
}

}  // namespace

fs::path RenderedJob::frame(int index) const {
  return folder / "frames" / io::frameFileName(index);
}

fs::path RenderedJob::maps(const Judged& segment) const {
  return folder / "maps" / formatted("%06d-%06d.exr", segment.first, segment.last);
}

RenderedJob readRenderedJob(const fs::path& folder) {
  const fs::path file = folder / "report.json";
  if (!fs::exists(file)) {
    throw InputError(folder.string(),
                     "expected a folder that `promenade render` finished: there is no report.json in it");
  }
  const Json root = io::readJson(file);
  try {
    RenderedJob job = jobFrom(root, file.string());
    job.folder = folder;
    job.report = io::readTextFile(file);
    return job;
  } catch (const Json::exception& error) {
    std::string what = error.what();
    if (const auto bracket = what.find("] "); bracket != std::string::npos) what.erase(0, bracket + 2);
    throw InputError(file.string(), "not a report of Promenade: " + what);
  }
}

}  // namespace promenade::app
