#include "src/walkthrough/report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "src/walkthrough/adaptation_json.h"
#include "src/walkthrough/statistics_json.h"

namespace promenade::walkthrough {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string transferOf(const DisplayModel& d) {
  switch (d.transfer) {
    case TransferFunction::kSrgb:
      return "srgb";
    case TransferFunction::kGamma:
      return "gamma" + OrderedJson(d.gamma).dump();
    case TransferFunction::kLinear:
      return "linear";
  }
  return "";
}

OrderedJson chromaticity(const glm::dvec2& c) {
  return {c.x, c.y};
}

// As a display file has it (docs/formats.md).
OrderedJson displayJson(const DisplayModel& d) {
  return {{"name", d.name},
          {"resolution", {d.resolution.width, d.resolution.height}},
          {"diagonal", d.diagonalMetres},
          {"distance", d.viewingDistanceMetres},
          {"peak", d.peakLuminance},
          {"black", d.blackLuminance},
          {"ambient", d.ambientIlluminance},
          {"reflectance", d.screenReflectance},
          {"transfer", transferOf(d)},
          {"primaries",
           {{"red", chromaticity(d.primaries.red)},
            {"green", chromaticity(d.primaries.green)},
            {"blue", chromaticity(d.primaries.blue)},
            {"white", chromaticity(d.primaries.white)}}},
          {"signal", d.signal == Signal::kNative ? "native" : "srgb"}};
}

OrderedJson viewJson(const ToneMapping& tone) {
  if (!tone.view) return OrderedJson();
  return {{"config", tone.view->config},
          {"display", tone.view->display},
          {"view", tone.view->view},
          {"input", tone.view->input}};
}

OrderedJson jobJson(const Report& report) {
  const Settings& s = report.settings;
  const JobDescription& job = report.job;
  return {{"scene", job.scene},
          {"path", job.path},
          {"size", {s.size.width, s.size.height}},
          {"supersample", s.supersample},
          {"fps", job.framesPerSecond},
          {"frames", s.frames.count()},
          {"method", s.method == Method::kFull ? "full" : "ibr"},
          {"tolerance", s.tolerancePercent},
          {"verify", 100.0 * s.probeShare},
          {"footprint_limit", s.warp.footprintLimit},
          {"display", s.display.name},
          {"seed", job.seed},
          {"threads", job.threads},
          {"first_frame", s.frames.first},
          {"last_frame", s.frames.last},
          {"spacing", s.keyframeSpacing},
          {"filter", s.antialiasing ? "temporal" : "box"},
          {"filter_radius", s.antialiasing ? OrderedJson(s.antialiasing->radius) : OrderedJson()},
          {"integrator", job.integrator},
          {"light", job.light},
          {"spp", job.pathsPerSample ? OrderedJson(*job.pathsPerSample) : OrderedJson()},
          {"spp_automatic", s.stopping.has_value()},
          {"tone", nameOf(s.tone.curve)},
          {"ocio", viewJson(s.tone)},
          {"exposure_ev", s.tone.exposureEv},
          {"luminance_unit", s.tone.candelasPerUnit},
          {"adaptation", adaptationJson(s.tone)},
          {"pixels_per_degree", s.display.pixelsPerDegree()},
          {"display_model", displayJson(s.display)},
          {"command", job.command},
          {"directory", job.directory}};
}

/// Nothing spent where the number of paths was given.
OrderedJson stoppingJson(const Statistics& statistics) {
  std::uint64_t paths = 0;
  int openTiles = 0;
  double worst = 0.0;
  double sum = 0.0;
  for (const FrameStatistics& frame : statistics.frames) {
    if (!frame.stopping) return OrderedJson();
    paths += frame.stopping->paths;
    openTiles += frame.stopping->openTiles;
    worst = std::max(worst, frame.stopping->predictedPercent);
    sum += frame.stopping->predictedPercent;
  }
  const double count = std::max<double>(1.0, static_cast<double>(statistics.frames.size()));
  return {{"paths", paths},
          {"predicted_percent_mean", sum / count},
          {"predicted_percent_worst", worst},
          {"tiles_open", openTiles}};
}

OrderedJson totalsJson(const Report& report) {
  const Statistics& s = report.statistics;
  const OutsideSeconds& o = report.seconds;
  const RayCounts rays = s.rays();
  return {{"frames", s.frames.size()},
          {"keyframes", s.keyframes()},
          {"samples", s.samples()},
          {"samples_traced", s.samplesTraced()},
          {"samples_probed", s.probes()},
          {"samples_disputed", s.disputed()},
          {"traced_fraction", s.tracedFraction()},
          {"rays", rays.primary + rays.scattered + rays.shadow},
          {"visibility_rays", rays.visibility},
          {"speedup_estimated", estimatedSpeedup(report)},
          {"stopping", stoppingJson(s)},
          {"seconds_wall", report.wallSeconds},
          {"seconds",
           {{"load", o.load},
            {"indirect", o.indirect},
            {"prepare", o.prepare},
            {"plan", o.plan},
            {"trace", s.seconds.trace},
            {"visibility", s.seconds.visibility},
            {"warp", s.seconds.warp},
            {"metric", s.seconds.metric},
            {"filter", s.seconds.filter},
            {"encode", o.encode},
            {"write", o.write}}},
          {"peak_rss_bytes", static_cast<std::uint64_t>(report.peakResidentBytes)},
          {"textures",
           {{"bytes", report.textures.bytes},
            {"levels_read", report.textures.levelsRead},
            {"levels_read_again", report.textures.levelsReadAgain}}}};
}

}  // namespace

double estimatedSpeedup(const Report& report) {
  const Statistics& s = report.statistics;
  double seconds = 0.0;
  std::uint64_t samples = 0;
  for (const FrameStatistics& frame : s.frames) {
    if (frame.kind != FrameKind::kKeyframe) continue;
    seconds += frame.seconds;
    samples += frame.samplesTraced;
  }
  if (samples == 0 || !(report.wallSeconds > 0.0)) return 0.0;
  // Of another renderer we see files, which may have been there already.
  if (report.settings.holes == Holes::kStay) return 0.0;
  const OutsideSeconds& o = report.seconds;
  const double same = o.load + o.indirect + o.prepare + o.encode + o.write + s.seconds.filter;
  const double traced = seconds / static_cast<double>(samples) * static_cast<double>(s.samples());
  return (same + traced) / report.wallSeconds;
}

std::string reportJson(const Report& report) {
  OrderedJson parts = toJson(report.statistics);
  OrderedJson root = {{"version", report.version}, {"job", jobJson(report)}, {"totals", totalsJson(report)}};
  if (report.light) {
    const LightReport& light = *report.light;
    root["light_solution"] = {
        {"file", light.file},       {"records", light.records}, {"records_added", light.recordsAdded},
        {"cameras", light.cameras}, {"rays", light.rays},       {"seconds", report.seconds.indirect}};
  }
  root["segments"] = std::move(parts["segments"]);
  root["frames"] = std::move(parts["frames"]);
  // Names of files may hold anything; what is not UTF-8 is replaced.
  return root.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

}  // namespace promenade::walkthrough
