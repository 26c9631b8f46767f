#include <algorithm>
#include <chrono>

#include "src/app/division.h"
#include "src/app/farm_job.h"
#include "src/app/farm_progress.h"
#include "src/app/job_report.h"
#include "src/app/machine.h"
#include "src/app/part_records.h"
#include "src/app/preparation.h"
#include "src/app/threads.h"
#include "src/app/verbs.h"
#include "src/app/walk_video.h"
#include "src/core/errors.h"

namespace promenade::app {
namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void refuse(const FarmJob& farm, const std::vector<int>& missing) {
  throw InputError(farm.folder.string(),
                   std::to_string(missing.size()) + " of " + std::to_string(farm.plan.tasks.size()) +
                       " tasks are not done: " + listOf(missing) + " (promenade work DIR --task K)");
}

}  // namespace

ExitStatus runAssemble(const AssembleOptions& options, Console& console) {
  const auto start = Clock::now();
  const FarmJob farm = openFarmJob(options.folder, options.threads);
  const LoadedJob& job = farm.job;
  const ThreadLimit threads(job.values.threads);
  const OutputFolder folder(farm.folder, job.hash, Existing::kResume);
  console.keepLog(folder.file("promenade.log"), job.options.command);
  const PartRecords records(folder, job.hash, job.settings.frames);

  walkthrough::Statistics statistics;
  std::vector<int> missing;
  const std::optional<Preparation> choices = preparationIn(folder, job.hash);
  if (!choices) missing.push_back(0);
  for (std::size_t i = 0; i < farm.plan.tasks.size(); ++i) {
    if (farm.plan.tasks[i].kind != TaskKind::kPart) continue;
    if (const auto record = records.find(farm.plan.tasks[i].part)) {
      statistics.append(record->statistics);
    } else {
      missing.push_back(static_cast<int>(i));
    }
  }
  if (!missing.empty()) refuse(farm, missing);

  walkthrough::Report report = reportOf(job, *choices, threads.count());
  report.statistics = std::move(statistics);
  if (const auto division = divisionIn(folder, job.hash)) report.seconds.plan = division->seconds;
  WalkVideo video(
      job.options.video.empty() ? folder.file("walkthrough.mp4") : std::filesystem::path(job.options.video),
      folder, report.settings, job.path.framesPerSecond);
  video.finish();
  // What all machines took together.
  const TaskRecord tasks = allTaskRecords(farm);
  report.statistics.seconds.trace += tasks.traceSeconds;
  report.seconds.load += tasks.loadSeconds;
  report.seconds.encode = video.seconds();
  report.seconds.write = report.statistics.seconds.output;
  report.peakResidentBytes = std::max(tasks.peakResidentBytes, peakResidentBytes());
  report.wallSeconds =
      tasks.wallSeconds + report.seconds.plan + std::chrono::duration<double>(Clock::now() - start).count();
  warnOfNoise(report.statistics, console);
  writeReport(report, folder, console);
  folder.removeKeyframes();
  return ExitStatus::kDone;
}

}  // namespace promenade::app
