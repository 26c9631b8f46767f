#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "src/app/farm_plan.h"
#include "src/app/farm_progress.h"
#include "src/app/interrupt.h"
#include "src/app/slurm.h"
#include "src/app/verbs.h"
#include "src/core/errors.h"
#include "src/io/json.h"

namespace promenade::app {
namespace {

namespace fs = std::filesystem;

constexpr int kPollsASecond = 10;  // of Ctrl-C
constexpr int kSecondsBetweenLooks = 2;

std::string joined(const std::vector<std::string>& jobs) {
  std::string text;
  for (const std::string& job : jobs) text += (text.empty() ? "" : ",") + job;
  return text;
}

fs::path submittedFile(const fs::path& folder) {
  return folder / "slurm" / "submitted.json";
}

void remember(const std::vector<std::string>& jobs, const FarmPlan& plan, const fs::path& folder) {
  io::writeJson(submittedFile(folder), nlohmann::ordered_json{{"job", plan.jobHash}, {"slurm_jobs", jobs}});
}

// The plan's Slurm jobs of an earlier call that are still in the queue.
std::vector<std::string> submittedBefore(const FarmPlan& plan, const fs::path& folder) {
  if (!fs::exists(submittedFile(folder))) return {};
  const nlohmann::json root = io::readJson(submittedFile(folder));
  try {
    if (root.at("job") != plan.jobHash) return {};
    return stillQueued(root.at("slurm_jobs").get<std::vector<std::string>>());
  } catch (const nlohmann::json::exception&) {
    throw InputError(submittedFile(folder).string(), "not a list of submitted jobs; remove it");
  }
}

// Until no job is left in the queue.
void follow(const std::vector<std::string>& jobs, const FarmPlan& plan, const fs::path& folder,
            Console& console) {
  const ProgressCallback show = console.progress();
  while (!stillQueued(jobs).empty()) {
    show({"tasks", plan.tasks.size() - tasksToDo(plan, folder).size(), plan.tasks.size()});
    for (int i = 0; i < kSecondsBetweenLooks * kPollsASecond; ++i) {
      throwIfInterrupted();
      std::this_thread::sleep_for(std::chrono::milliseconds(1000 / kPollsASecond));
    }
  }
  console.endProgress();
}

}  // namespace

ExitStatus runSubmit(const SubmitOptions& options, Console& console) {
  if (!options.slurm) {
    throw InputError("expected --slurm (other queues: give them template.openjd.json of the job's folder)");
  }
  const fs::path folder = fs::absolute(options.folder).lexically_normal();
  const FarmPlan plan = readPlan(folder / "plan.json");
  const fs::path report = folder / "report.json";  // the last that the assembly writes but for the page
  std::vector<std::string> jobs = submittedBefore(plan, folder);
  if (jobs.empty()) {
    const std::vector<int> toDo = tasksToDo(plan, folder);
    if (toDo.empty() && fs::exists(report)) {
      console.result(options.folder + ": done already\n");
      return ExitStatus::kDone;
    }
    fs::remove(report);
    jobs = submitToSlurm(plan.tasks, toDo, folder, options);
    remember(jobs, plan, folder);
    console.result(options.folder + ": " + std::to_string(toDo.size()) + " of " +
                   std::to_string(plan.tasks.size()) + " tasks submitted as jobs " + joined(jobs) + "\n");
  } else {
    console.result(options.folder + ": already in the queue as jobs " + joined(jobs) + "\n");
  }
  if (options.noWait) return ExitStatus::kDone;
  try {
    follow(jobs, plan, folder, console);
  } catch (const Interrupted&) {
    console.warning("the jobs go on; submit again to watch them, scancel " + joined(jobs) + " to end them");
    throw;
  }
  if (!fs::exists(report)) {
    const std::vector<int> toDo = tasksToDo(plan, folder);
    throw CannotContinue(options.folder + ": " +
                         (toDo.empty() ? "the assembly failed" : "tasks are not done: " + listOf(toDo)) +
                         "; " + (folder / "slurm").string() + " has what they said; submit again to go on");
  }
  console.result(options.folder + ": done\n");
  return ExitStatus::kDone;
}

}  // namespace promenade::app
