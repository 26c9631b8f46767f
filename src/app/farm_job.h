#pragma once
// A planned job, opened by a verb that works on it.

#include <filesystem>
#include <string>

#include "src/app/farm_plan.h"
#include "src/app/render_job.h"

namespace promenade::app {

struct FarmJob {
  std::filesystem::path folder;  ///< absolute
  FarmPlan plan;
  LoadedJob job;
};

/// Reads the plan in `folder` and loads its job, from the folder where it was planned. `threads`: as typed,
/// empty: as planned. Throws InputError if the job is no longer the one that was planned: a file of the scene
/// or the program has changed.
[[nodiscard]] FarmJob openFarmJob(const std::string& folder, const std::string& threads);

/// What a task took: DIR/tasks/000003.json.
struct TaskRecord {
  double wallSeconds = 0.0;
  double loadSeconds = 0.0;
  double traceSeconds = 0.0;  ///< of a kKeyframe; those of a part are in its record
  double peakResidentBytes = 0.0;
};
void writeTaskRecord(const FarmJob& job, int task, const TaskRecord& record);
/// Sums over all tasks of which there is a record; the largest of the memory.
[[nodiscard]] TaskRecord allTaskRecords(const FarmJob& job);

}  // namespace promenade::app
