#include "src/app/slurm.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>

#include "src/app/folders.h"
#include "src/app/shell_words.h"
#include "src/app/subprocess.h"
#include "src/core/errors.h"
#include "src/io/text_file.h"

namespace promenade::app {
namespace {

constexpr int kLargestArray = 1000;

std::string joined(const std::vector<std::string>& parts, const char* separator) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : separator) + part;
  return text;
}

const char* jobNameOf(TaskKind kind) {
  switch (kind) {
    case TaskKind::kPrepare:
      return "promenade-prepare";
    case TaskKind::kKeyframe:
      return "promenade-keyframe";
    case TaskKind::kPart:
      return "promenade-part";
  }
  return "";
}

// What every call of sbatch has. A node that fails gives its tasks back to the queue: they may be repeated.
std::vector<std::string> sbatch(const std::string& name, const std::filesystem::path& log,
                                const SubmitOptions& options) {
  std::vector<std::string> arguments{"sbatch",
                                     "--parsable",
                                     "--requeue",
                                     "--open-mode=append",
                                     "--job-name=" + name,
                                     "--output=" + log.string()};
  if (!options.partition.empty()) arguments.push_back("--partition=" + options.partition);
  if (!options.cpus.empty()) arguments.push_back("--cpus-per-task=" + options.cpus);
  if (!options.memory.empty()) arguments.push_back("--mem=" + options.memory);
  if (!options.timeLimit.empty()) arguments.push_back("--time=" + options.timeLimit);
  return arguments;
}

}  // namespace

std::string taskScript(const std::string& program, const std::filesystem::path& folder) {
  return "#!/bin/sh\n"
         "# Written by `promenade submit`: does task $1 + SLURM_ARRAY_TASK_ID of the plan.\n"
         "exec " +
         shellWords({program, "work", folder.string()}) +
         " --task \"$(($1 + SLURM_ARRAY_TASK_ID))\""
         " --threads \"${SLURM_CPUS_PER_TASK:-${SLURM_CPUS_ON_NODE:-0}}\"\n";
}

std::string assembleScript(const std::string& program, const std::filesystem::path& folder) {
  return "#!/bin/sh\n"
         "# Written by `promenade submit`: makes video and report of what the tasks left.\n"
         "exec " +
         shellWords({program, "assemble", folder.string()}) + "\n";
}

std::string arrayOf(const std::vector<int>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t end = i + 1;
    while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1) ++end;
    if (!text.empty()) text.append(",");
    text.append(std::to_string(numbers[i]));
    if (end - i > 1) text.append("-").append(std::to_string(numbers[end - 1]));
    i = end;
  }
  return text;
}

std::vector<Submission> submissionsOf(const std::vector<Task>& tasks, const std::vector<int>& toDo,
                                      const std::filesystem::path& folder, const SubmitOptions& options) {
  const std::filesystem::path own = folder / "slurm";
  std::vector<Submission> submissions;
  int number = 0;
  for (const Stage& stage : stagesOf(tasks)) {
    const int end = stage.first + stage.count;
    bool isSubmitted = false;
    for (int first = stage.first; first < end; first += kLargestArray) {
      std::vector<int> elements;
      for (const int task : toDo) {
        if (task >= first && task < std::min(first + kLargestArray, end)) elements.push_back(task - first);
      }
      if (elements.empty()) continue;
      auto arguments = sbatch(jobNameOf(stage.kind), own / "%x-%A-%a.txt", options);
      arguments.push_back("--array=" + arrayOf(elements));
      arguments.push_back((own / "task.sh").string());
      arguments.push_back(std::to_string(first));
      submissions.push_back({std::move(arguments), number});
      isSubmitted = true;
    }
    if (isSubmitted) ++number;
  }
  auto arguments = sbatch("promenade-assemble", own / "%x-%j.txt", options);
  arguments.push_back((own / "assemble.sh").string());
  submissions.push_back({std::move(arguments), number});
  return submissions;
}

std::vector<std::string> submitToSlurm(const std::vector<Task>& tasks, const std::vector<int>& toDo,
                                       const std::filesystem::path& folder, const SubmitOptions& options) {
  makeFolder(folder / "slurm");
  io::writeTextFile(folder / "slurm" / "task.sh", taskScript(ownProgram(), folder));
  io::writeTextFile(folder / "slurm" / "assemble.sh", assembleScript(ownProgram(), folder));
  std::vector<std::string> all;
  std::vector<std::string> before;  // jobs of the stage before
  std::vector<std::string> these;
  int stage = 0;
  for (const Submission& submission : submissionsOf(tasks, toDo, folder, options)) {
    if (submission.stage != stage) {
      before = std::exchange(these, {});
      stage = submission.stage;
    }
    std::vector<std::string> arguments = submission.arguments;
    if (!before.empty()) {
      // A stage that failed takes those that wait for it out of the queue.
      arguments.insert(arguments.begin() + 1,
                       {"--dependency=afterok:" + joined(before, ":"), "--kill-on-invalid-dep=yes"});
    }
    const ProgramResult result = runProgram(arguments);
    const std::string job = result.output.substr(0, result.output.find_first_of(";\n"));
    if (result.status != 0 || job.empty()) {
      if (!all.empty()) (void)runProgram({"scancel", joined(all, ",")});
      throw CannotContinue("sbatch refused the job (exit status " + std::to_string(result.status) + ")");
    }
    these.push_back(job);
    all.push_back(job);
  }
  return all;
}

std::vector<std::string> stillQueued(const std::vector<std::string>& jobs) {
  const ProgramResult result = runProgram({"squeue", "--noheader", "--me", "--format=%F"});
  if (result.status != 0) return jobs;  // a controller that does not answer now may answer later
  std::istringstream lines(result.output);
  std::set<std::string> queued;
  for (std::string line; lines >> line;) queued.insert(line);
  std::vector<std::string> still;
  for (const std::string& job : jobs) {
    if (queued.contains(job)) still.push_back(job);
  }
  return still;
}

}  // namespace promenade::app
