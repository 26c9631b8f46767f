#pragma once
// A job divided into tasks that any machine may do, in any order, any number of times (docs/farm.md):
// DIR/plan.json.

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "src/app/options.h"
#include "src/walkthrough/walkthrough.h"

namespace promenade::app {

enum class TaskKind {
  kPrepare,   ///< light solution and exposure: once for the walk
  kKeyframe,  ///< a keyframe that two parts share
  kPart,      ///< a part of the walk (division.h)
};

struct Task {
  TaskKind kind = TaskKind::kPrepare;
  walkthrough::Segment part;  ///< kPart; kKeyframe: first == last, the keyframe
};

/// The tasks of a stage follow each other: [first, first + count). Each stage is quickest when the one before
/// it is done, but needs nothing of it: a task makes what it misses itself, with the same result.
struct Stage {
  TaskKind kind = TaskKind::kPrepare;
  int first = 0;
  int count = 0;
};

struct FarmPlan {
  std::string jobHash;
  std::filesystem::path workingFolder;  ///< where the job's relative file names begin
  std::vector<std::string> arguments;   ///< of the job, as for `promenade render`
  std::vector<Task> tasks;              ///< task K is tasks[K]
};

/// One kPrepare, a kKeyframe for every keyframe between parts, a kPart for every part.
[[nodiscard]] std::vector<Task> tasksOf(const walkthrough::Plan& parts);
/// None is empty.
[[nodiscard]] std::vector<Stage> stagesOf(const std::vector<Task>& tasks);
/// Frames that two parts share.
[[nodiscard]] std::set<int> sharedKeyframes(const std::vector<Task>& tasks);
[[nodiscard]] std::string describe(const Task& task);

/// The arguments that give the same job again, without those that are about this run alone (--out, --resume,
/// --overwrite, --config, --quiet, --log-level).
[[nodiscard]] std::vector<std::string> argumentsOf(const RenderOptions& options);

void writePlan(const std::filesystem::path& file, const FarmPlan& plan);
/// Throws InputError if there is no plan, or none of this version of the program.
[[nodiscard]] FarmPlan readPlan(const std::filesystem::path& file);

}  // namespace promenade::app
