#pragma once
// A planned job as Slurm jobs: an array a stage, each waiting for the one before, and the assembly at the
// end.

#include <filesystem>
#include <string>
#include <vector>

#include "src/app/farm_options.h"
#include "src/app/farm_plan.h"

namespace promenade::app {

/// The batch script of a task: its number is the script's argument plus that of the array's element.
[[nodiscard]] std::string taskScript(const std::string& program, const std::filesystem::path& folder);
[[nodiscard]] std::string assembleScript(const std::string& program, const std::filesystem::path& folder);

/// Ascending numbers as sbatch --array takes them: "0-3,7".
[[nodiscard]] std::string arrayOf(const std::vector<int>& numbers);

/// One call of sbatch.
struct Submission {
  /// Without the dependency, which is known when the calls before are made.
  std::vector<std::string> arguments;
  int stage = 0;  ///< waits for all submissions of the stage before
};

/// Arrays for the tasks `toDo` (ascending) of a plan, and the assembly. `folder` is absolute; the scripts are
/// in its folder `slurm`. Elements of arrays are numbered below 1000, which every cluster allows unless its
/// MaxArraySize was lowered.
[[nodiscard]] std::vector<Submission> submissionsOf(const std::vector<Task>& tasks,
                                                    const std::vector<int>& toDo,
                                                    const std::filesystem::path& folder,
                                                    const SubmitOptions& options);

/// Writes the scripts and submits everything. Returns the numbers of the jobs, the assembly's last. Throws
/// InputError if there is no sbatch, CannotContinue if it refuses (what was submitted before is cancelled).
[[nodiscard]] std::vector<std::string> submitToSlurm(const std::vector<Task>& tasks,
                                                     const std::vector<int>& toDo,
                                                     const std::filesystem::path& folder,
                                                     const SubmitOptions& options);

/// Those of `jobs` that wait or run. All of them if the cluster does not answer: it may answer later.
[[nodiscard]] std::vector<std::string> stillQueued(const std::vector<std::string>& jobs);

}  // namespace promenade::app
