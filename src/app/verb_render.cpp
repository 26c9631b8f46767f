#include <chrono>
#include <cstdio>
#include <utility>

#include "src/app/forecast.h"
#include "src/app/frame_output.h"
#include "src/app/interrupt.h"
#include "src/app/machine.h"
#include "src/app/output_folder.h"
#include "src/app/render_job.h"
#include "src/app/report_page.h"
#include "src/app/solved_light.h"
#include "src/app/threads.h"
#include "src/app/timed_renderer.h"
#include "src/app/verbs.h"
#include "src/core/errors.h"
#include "src/io/text_file.h"
#include "src/render/path_renderer.h"
#include "src/walkthrough/report.h"

namespace promenade::app {
namespace {

using Clock = std::chrono::steady_clock;
using walkthrough::Stopwatch;

using Solution = std::shared_ptr<const render::LightSolution>;

std::unique_ptr<Renderer> rendererFor(const Scene& scene, int pathsPerSample, std::uint64_t seed, int threads,
                                      const Solution& solution) {
  return render::makePathRenderer(scene, {.pathsPerSample = pathsPerSample,
                                          .seed = seed,
                                          .threads = threads,
                                          .solution = solution,
                                          .checkpoint = [] { throwIfInterrupted(); }});
}

// Of --spp auto: the paths ran out before a viewer would have called the frames done.
void warnOfNoise(const walkthrough::Statistics& statistics, Console& console) {
  int tiles = 0;
  int frames = 0;
  for (const walkthrough::FrameStatistics& frame : statistics.frames) {
    if (!frame.stopping || frame.stopping->openTiles == 0) continue;
    tiles += frame.stopping->openTiles;
    ++frames;
  }
  if (frames == 0) return;
  console.warning(std::to_string(frames) + " frames are still noisy after " +
                  std::to_string(walkthrough::StoppingRule{}.mostPaths) + " paths a sample, in " +
                  std::to_string(tiles) + " tiles; noise may be visible and split segments");
}

// The first frame that must be rendered again so that the rest comes out as if the job had never stopped: the
// beginning of the first segment that is not finished (with its keyframe, which is the source of what
// follows).
int resumeAt(const walkthrough::Settings& settings, int finished) {
  if (settings.method == walkthrough::Method::kFull) return settings.frames.first + finished;
  const int whole = finished > 0 ? (finished - 1) / settings.keyframeSpacing : 0;
  return settings.frames.first + whole * settings.keyframeSpacing;
}

// The walk, with an estimate as soon as a keyframe is measured, and the time that is left.
walkthrough::Statistics renderWithForecast(const paths::CameraPath& path, const Renderer& renderer,
                                           const walkthrough::Settings& settings,
                                           walkthrough::Outputs outputs, Console& console) {
  const bool full = settings.method == walkthrough::Method::kFull;
  Forecast forecast(settings.frames.count(), full ? 1 : settings.keyframeSpacing);
  const TimedRenderer timed(renderer, [&, first = true](double seconds) mutable {
    forecast.keyframeRendered(seconds);
    if (std::exchange(first, false)) console.info(forecast.firstEstimate());
  });
  const auto start = Clock::now();
  outputs.frame = [&, store = std::move(outputs.frame)](walkthrough::FinishedFrame&& frame) {
    forecast.frameFinished(frame.kind == walkthrough::FrameKind::kKeyframe);
    store(std::move(frame));
  };
  outputs.progress = console.progress(
      [&] { return forecast.secondsLeft(std::chrono::duration<double>(Clock::now() - start).count()); });
  // The clock of rate and time left starts here.
  outputs.progress({"frames", 0, static_cast<std::uint64_t>(settings.frames.count())});
  return walkthrough::renderWalkthrough(path, timed, settings, outputs);
}

std::string summary(const walkthrough::Report& report, const OutputFolder& folder) {
  const walkthrough::Statistics& s = report.statistics;
  char text[256];
  std::snprintf(text, sizeof(text), ": %zu frames, %d keyframes, %.1f%% of the samples ray traced, %.1f s\n",
                s.frames.size(), s.keyframes(), 100.0 * s.tracedFraction(), report.wallSeconds);
  return folder.file("").parent_path().string() + text;
}

}  // namespace

ExitStatus runRender(const RenderOptions& options, Console& console) {
  const auto start = Clock::now();
  const RenderValues values = renderValues(options);
  const ThreadLimit threads(values.threads);

  walkthrough::Report report;
  Scene scene;
  paths::CameraPath path;
  {
    const Stopwatch watch(report.seconds.load);
    scene = sceneFor(options);
    path = walkFor(options, values, scene);
  }
  throwIfInterrupted();
  walkthrough::Settings settings = settingsFor(options, values, path);
  const std::string hash = jobHash(options, settings, scene, path);
  const OutputFolder folder(options.out, hash, options.overwrite ? Existing::kOverwrite : Existing::kResume);
  console.keepLog(folder.file("promenade.log"), options.command);
  for (const std::string& warning : scene.warnings) console.warning(scene.source + ": " + warning);
  const std::filesystem::path video =
      options.video.empty() ? folder.file("walkthrough.mp4") : std::filesystem::path(options.video);
  const int finished = folder.finishedFrom(settings.frames.first, settings.frames.last);
  if (options.resume && finished == 0) {
    throw InputError(options.out, "--resume: there are no frames of this job to go on from");
  }
  if (finished == settings.frames.count() && std::filesystem::exists(video) &&
      std::filesystem::exists(folder.file("report.json"))) {
    console.result(options.out + ": all frames of this job are there; --overwrite renders them again\n");
    return ExitStatus::kDone;
  }

  report.version = PROMENADE_VERSION;
  report.job = {.scene = options.scene,
                .path = options.path.empty() ? path.name : options.path,
                .framesPerSecond = path.framesPerSecond,
                .integrator = options.integrator,
                .light = options.sky                   ? "sky"
                         : options.environment.empty() ? "scene"
                                                       : options.environment,
                .pathsPerSample = values.pathsPerSample,
                .seed = values.seed,
                .threads = threads.count(),
                .command = options.command,
                .directory = std::filesystem::current_path().string()};
  Solution solution;
  if (options.integrator == "walkthrough") {
    const Stopwatch watch(report.seconds.indirect);
    const std::filesystem::path file = options.lightSolution.empty()
                                           ? folder.file("light-solution.bin")
                                           : std::filesystem::path(options.lightSolution);
    SolvedLight light =
        solveLightOf(path, settings.size, scene,
                     {file, lightHash(options, scene), values.seed, report.job.threads}, console);
    solution = std::move(light.solution);
    report.light = std::move(light.report);
  }
  std::unique_ptr<Renderer> renderer;
  {
    const Stopwatch watch(report.seconds.load);
    renderer = rendererFor(scene, values.pathsPerSample.value_or(render::PathSettings{}.pathsPerSample),
                           values.seed, report.job.threads, solution);
  }
  if (!values.exposureEv) {
    const Stopwatch watch(report.seconds.prepare);
    settings.tone.exposureEv =
        walkthrough::automaticExposure(path, settings.frames, *renderer, settings.size);
  }

  FrameOutput output(folder, path, settings.size, {video, settings.tone, options.scene, hash});
  output.startAt(settings.frames.first);
  for (int k = 0; k < finished; ++k) output.addFinished(settings.frames.first + k);
  walkthrough::Outputs outputs;
  outputs.frame = [&](walkthrough::FinishedFrame&& frame) { output.add(std::move(frame)); };
  if (options.maps) {
    folder.makeMapsFolder();
    outputs.middle = [&](walkthrough::JudgedMiddle&& middle) { output.addMiddle(middle); };
  }
  report.settings = settings;
  report.resumedFrom = settings.frames.first;
  if (finished < settings.frames.count()) {
    walkthrough::Settings remaining = settings;
    remaining.frames.first = resumeAt(settings, finished);
    report.resumedFrom = remaining.frames.first;
    if (finished > 0) console.info("going on at frame " + std::to_string(remaining.frames.first));
    report.statistics = renderWithForecast(path, *renderer, remaining, std::move(outputs), console);
  }
  output.finish();
  console.endProgress();
  warnOfNoise(report.statistics, console);

  report.seconds.encode = output.secondsEncoding();
  report.seconds.write = output.secondsWriting();
  report.peakResidentBytes = peakResidentBytes();
  report.wallSeconds = std::chrono::duration<double>(Clock::now() - start).count();
  io::writeTextFile(folder.file("report.json"), walkthrough::reportJson(report));
  writeReportPage(options.out, std::nullopt, folder.file("report.html"), console.progress());
  console.endProgress();
  console.result(summary(report, folder));
  return ExitStatus::kDone;
}

}  // namespace promenade::app
