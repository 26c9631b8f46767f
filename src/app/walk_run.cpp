#include "src/app/walk_run.h"

#include <map>

#include "src/app/division.h"
#include "src/app/elapsed.h"
#include "src/app/forecast.h"
#include "src/app/frame_output.h"
#include "src/app/job_report.h"
#include "src/app/machine.h"
#include "src/app/part_records.h"
#include "src/app/walk_video.h"
#include "src/core/errors.h"

namespace promenade::app {
namespace {

using walkthrough::Segment;

// Parts in the order of time, those that are finished with what was kept of them.
struct Progression {
  std::map<int, PartRecord> done;  ///< by first frame
  walkthrough::Plan missing;
};

Progression progressionOf(const PartRecords& records, const walkthrough::Plan& parts) {
  Progression progression;
  for (const Segment& part : parts) {
    if (auto record = records.find(part)) {
      progression.done.emplace(part.first, std::move(*record));
    } else {
      progression.missing.push_back(part);
    }
  }
  return progression;
}

bool hasFrames(const OutputFolder& folder, walkthrough::FrameRange frames) {
  for (int frame = frames.first; frame <= frames.last; ++frame) {
    if (std::filesystem::exists(folder.frame(frame))) return true;
  }
  return false;
}

// Renders the missing parts, with an estimate as soon as a keyframe is measured, and the time that is left.
// Each becomes a record when `outputs.part` has returned.
void renderMissing(const LoadedJob& job, const Renderer& renderer, const walkthrough::Settings& settings,
                   walkthrough::Outputs outputs, const PartRecords& records, Progression& progression,
                   Console& console) {
  int frames = 0;
  int keyframes = 0;
  for (const Segment& part : progression.missing) {
    const walkthrough::FrameRange delivered = framesOf(part, settings.frames);
    frames += delivered.count();
    keyframes += part.last != part.first && delivered.last == part.last ? 2 : 1;
  }
  if (settings.method == walkthrough::Method::kFull) keyframes = frames;
  Forecast forecast(frames, keyframes);
  outputs.keyframe = [&, first = true](double seconds) mutable {
    forecast.keyframeRendered(seconds);
    if (std::exchange(first, false)) console.info(forecast.firstEstimate());
  };
  outputs.frame = [&, store = std::move(outputs.frame)](walkthrough::FinishedFrame&& frame) {
    forecast.frameFinished(frame.kind == walkthrough::FrameKind::kKeyframe);
    store(std::move(frame));
  };
  const auto start = Clock::now();
  auto partStart = start;
  outputs.part = [&, finishFrames = std::move(outputs.part)](const Segment& part,
                                                             const walkthrough::Statistics& statistics) {
    finishFrames(part, statistics);
    PartRecord record{statistics, secondsSince(partStart)};
    partStart = Clock::now();
    records.write(part, record);
    progression.done.emplace(part.first, std::move(record));
  };
  outputs.progress = console.progress([&] { return forecast.secondsLeft(secondsSince(start)); });
  (void)walkthrough::renderParts(job.path, renderer, settings, progression.missing, outputs);
}

}  // namespace

ExitStatus runWalk(const LoadedJob& job, const std::optional<walkthrough::Plan>& given, int threads,
                   const PrepareWalk& prepareWalk, Console& console) {
  const auto start = Clock::now();
  const RenderOptions& options = job.options;
  const OutputFolder folder(options.out, job.hash,
                            options.overwrite ? Existing::kOverwrite : Existing::kResume);
  console.keepLog(folder.file("promenade.log"), options.command);
  for (const std::string& warning : job.scene.warnings) console.warning(job.scene.source + ": " + warning);
  const std::filesystem::path videoFile =
      options.video.empty() ? folder.file("walkthrough.mp4") : std::filesystem::path(options.video);
  if (options.resume && !hasFrames(folder, job.settings.frames)) {
    throw InputError(options.out, "--resume: there are no frames of this job to go on from");
  }
  const PartRecords records(folder, job.hash, job.settings.frames);
  std::optional<Division> division = given ? Division{*given} : divisionIn(folder, job.hash);
  const bool isDivided = division.has_value();
  Progression progression = progressionOf(records, isDivided ? division->parts : walkthrough::Plan());
  if (isDivided && progression.missing.empty() && std::filesystem::exists(videoFile) && isReported(folder)) {
    console.result(options.out + ": all frames of this job are there; --overwrite renders them again\n");
    return ExitStatus::kDone;
  }

  const std::optional<Preparation> earlier = preparationIn(folder, job.hash);
  const PreparedJob prepared = prepareWalk(folder);
  if (!isDivided) {
    division = divide(job, *prepared.renderer, folder, console);
    progression = progressionOf(records, division->parts);
  }
  walkthrough::Report report = reportOf(job, prepared.choices, threads);
  report.seconds.load += prepared.secondsBuilding;
  report.seconds.plan = division->seconds;
  // What this run does not do again was paid for by an earlier one.
  if (earlier) report.wallSeconds += earlier->secondsIndirect + earlier->secondsChoosing;
  if (isDivided) report.wallSeconds += division->seconds;
  for (const auto& [first, record] : progression.done) {
    report.wallSeconds += record.wallSeconds;
    report.seconds.write += record.statistics.seconds.output;
  }

  FrameFiles files(folder, job.path, options.scene, job.hash);
  WalkVideo video(videoFile, folder, report.settings, job.path.framesPerSecond);
  if (!progression.missing.empty()) {
    walkthrough::Outputs outputs;
    outputs.frame = [&](walkthrough::FinishedFrame&& frame) {
      video.add(frame.index, frame.radiance);
      files.write(std::move(frame));
    };
    outputs.part = [&](const Segment&, const walkthrough::Statistics&) { files.finish(); };
    if (options.maps) {
      folder.makeMapsFolder();
      outputs.middle = [&](walkthrough::JudgedMiddle&& middle) { files.writeMiddle(std::move(middle)); };
    }
    if (!progression.done.empty()) {
      console.info("going on at frame " + std::to_string(progression.missing.front().first));
    }
    renderMissing(job, *prepared.renderer, report.settings, std::move(outputs), records, progression,
                  console);
  }
  video.finish();
  console.endProgress();

  for (const auto& [first, record] : progression.done) report.statistics.append(record.statistics);
  warnOfNoise(report.statistics, console);
  report.seconds.encode = video.seconds();
  report.seconds.write += files.seconds();
  report.peakResidentBytes = peakResidentBytes();
  report.textures = prepared.renderer->textureUse();
  warnOfTextures(report.textures, console);
  report.wallSeconds += job.secondsLoading + secondsSince(start);
  writeReport(report, folder, console);
  return ExitStatus::kDone;
}

}  // namespace promenade::app
