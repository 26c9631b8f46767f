#include "src/app/job_report.h"

#include <filesystem>
#include <string>

#include "src/app/formatted.h"
#include "src/app/report_page.h"
#include "src/io/text_file.h"

namespace promenade::app {

walkthrough::Report reportOf(const LoadedJob& job, const Preparation& choices, int threads) {
  const RenderOptions& options = job.options;
  walkthrough::Report report;
  report.version = PROMENADE_VERSION;
  report.job = {.scene = options.scene,
                .path = options.path.empty() ? job.path.name : options.path,
                .framesPerSecond = job.path.framesPerSecond,
                .integrator = options.integrator,
                .light = options.sky                   ? "sky"
                         : options.environment.empty() ? "scene"
                                                       : options.environment,
                .pathsPerSample = job.values.pathsPerSample,
                .seed = job.values.seed,
                .threads = threads,
                .command = options.command,
                .directory = std::filesystem::current_path().string()};
  report.settings = job.settings;
  report.settings.tone = choices.tone;
  report.settings.tone.view = job.settings.tone.view;
  if (choices.light) report.light = choices.light->report;
  report.seconds.load = job.secondsLoading;
  report.seconds.indirect = choices.secondsIndirect;
  report.seconds.prepare = choices.secondsChoosing;
  return report;
}

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

void warnOfTextures(const TextureUse& textures, Console& console) {
  if (textures.levelsReadAgain == 0) return;
  console.warning("mip levels of textures were decoded " + std::to_string(textures.levelsRead) + " times, " +
                  std::to_string(textures.levelsReadAgain) +
                  " times again for want of memory (--texture-memory)");
}

void writeReport(const walkthrough::Report& report, const OutputFolder& folder, Console& console) {
  io::writeTextFile(folder.file("report.json"), walkthrough::reportJson(report));
  const std::filesystem::path directory = folder.file("").parent_path();
  writeReportPage(directory, std::nullopt, folder.file("report.html"), console.progress());
  console.endProgress();
  const walkthrough::Statistics& s = report.statistics;
  console.result(directory.string() +
                 formatted(": %zu frames, %d keyframes, %.1f%% of the samples ray traced, %.1f s\n",
                           s.frames.size(), s.keyframes(), 100.0 * s.tracedFraction(), report.wallSeconds));
}

bool isReported(const OutputFolder& folder) {
  return std::filesystem::exists(folder.file("report.json")) &&
         std::filesystem::exists(folder.file("report.html"));
}

}  // namespace promenade::app
