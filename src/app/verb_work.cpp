#include "src/app/elapsed.h"
#include "src/app/farm_job.h"
#include "src/app/folders.h"
#include "src/app/frame_output.h"
#include "src/app/machine.h"
#include "src/app/part_records.h"
#include "src/app/preparation.h"
#include "src/app/shared_keyframes.h"
#include "src/app/threads.h"
#include "src/app/values.h"
#include "src/app/verbs.h"

namespace promenade::app {
namespace {

using walkthrough::Segment;

void renderPart(const Segment& part, const LoadedJob& job, const walkthrough::Settings& settings,
                const Renderer& renderer, const SharedKeyframes& shared, const OutputFolder& folder,
                const PartRecords& records, Console& console) {
  const auto start = Clock::now();
  FrameFiles files(folder, job.path, job.options.scene, job.hash);
  walkthrough::Outputs outputs;
  outputs.frame = [&](walkthrough::FinishedFrame&& frame) { files.write(std::move(frame)); };
  if (job.options.maps) {
    folder.makeMapsFolder();
    outputs.middle = [&](walkthrough::JudgedMiddle&& middle) { files.writeMiddle(std::move(middle)); };
  }
  outputs.part = [&](const Segment&, const walkthrough::Statistics& statistics) {
    files.finish();
    records.write(part, {statistics, secondsSince(start)});
  };
  outputs.progress = console.progress();
  (void)walkthrough::renderParts(job.path, renderer, settings, {part}, outputs, &shared);
  console.endProgress();
}

}  // namespace

ExitStatus runWork(const WorkOptions& options, Console& console) {
  const auto start = Clock::now();
  const FarmJob farm = openFarmJob(options.folder, options.threads);
  const LoadedJob& job = farm.job;
  const int number = integerFrom(options.task, 0, static_cast<int>(farm.plan.tasks.size()) - 1, "--task");
  const Task& task = farm.plan.tasks[static_cast<std::size_t>(number)];
  const ThreadLimit threads(job.values.threads);
  const OutputFolder folder(farm.folder, job.hash, Existing::kShare);
  const PartRecords records(folder, job.hash, job.settings.frames);
  const SharedKeyframes shared(folder, job.path, job.settings, job.hash, sharedKeyframes(farm.plan.tasks));
  const std::string name = "task " + std::to_string(number) + " (" + describe(task) + ")";
  const bool isDone = task.kind == TaskKind::kPrepare    ? preparationIn(folder, job.hash).has_value()
                      : task.kind == TaskKind::kKeyframe ? shared.find(task.part.first).has_value()
                                                         : records.find(task.part).has_value();
  if (isDone) {
    console.result(name + ": done already\n");
    return ExitStatus::kDone;
  }

  const PreparedJob prepared = prepare(job, folder, threads.count(), console);
  walkthrough::Settings settings = job.settings;
  settings.tone = prepared.choices.tone;
  TaskRecord record;
  record.loadSeconds = job.secondsLoading + prepared.secondsBuilding;
  if (task.kind != TaskKind::kPrepare) makeFolder(folder.file("keyframes"));
  if (task.kind == TaskKind::kKeyframe) {
    const int frame = task.part.first;
    const walkthrough::Keyframe keyframe =
        walkthrough::traceKeyframe(job.path, *prepared.renderer, settings, frame);
    record.traceSeconds = keyframe.statistics.seconds;
    shared.keep(frame, keyframe);
  }
  if (task.kind == TaskKind::kPart) {
    renderPart(task.part, job, settings, *prepared.renderer, shared, folder, records, console);
  }
  record.wallSeconds = secondsSince(start);
  record.peakResidentBytes = peakResidentBytes();
  writeTaskRecord(farm, number, record);
  console.result(name + ": done\n");
  return ExitStatus::kDone;
}

}  // namespace promenade::app
