#include "src/app/farm_job.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "src/app/folders.h"
#include "src/app/formatted.h"
#include "src/app/options.h"
#include "src/core/errors.h"
#include "src/io/json.h"

namespace promenade::app {
namespace {

namespace fs = std::filesystem;

fs::path recordFile(const FarmJob& job, int task) {
  return job.folder / "tasks" / formatted("%06d.json", task);
}

}  // namespace

FarmJob openFarmJob(const std::string& folder, const std::string& threads) {
  FarmJob farm;
  farm.folder = fs::absolute(folder).lexically_normal();
  farm.plan = readPlan(farm.folder / "plan.json");
  // Relative file names of the job begin where it was planned, whichever machine and folder this runs in.
  std::error_code error;
  fs::current_path(farm.plan.workingFolder, error);
  if (error) {
    throw InputError(farm.plan.workingFolder.string(),
                     "the job was planned in this folder, which cannot be entered here: " + error.message());
  }
  std::vector<std::string> arguments{"render"};
  arguments.insert(arguments.end(), farm.plan.arguments.begin(), farm.plan.arguments.end());
  arguments.push_back("--out=" + farm.folder.string());
  if (!threads.empty()) arguments.push_back("--threads=" + threads);
  farm.job = loadJob(parseCommandLine(arguments).render);
  if (farm.job.hash != farm.plan.jobHash) {
    throw InputError(farm.folder.string(),
                     "the scene, or the program, is not the one that was planned; plan the job again");
  }
  return farm;
}

void writeTaskRecord(const FarmJob& job, int task, const TaskRecord& record) {
  const auto& [wall, load, trace, peak] = record;
  makeFolder(job.folder / "tasks");
  io::writeJson(recordFile(job, task), nlohmann::ordered_json{{"seconds_wall", wall},
                                                              {"seconds_load", load},
                                                              {"seconds_trace", trace},
                                                              {"peak_rss_bytes", peak}});
}

TaskRecord allTaskRecords(const FarmJob& job) {
  TaskRecord all;
  for (int task = 0; task < static_cast<int>(job.plan.tasks.size()); ++task) {
    const fs::path file = recordFile(job, task);
    if (!fs::is_regular_file(file)) continue;
    const nlohmann::json root = io::readJson(file);
    try {
      all.wallSeconds += root.at("seconds_wall").get<double>();
      all.loadSeconds += root.at("seconds_load").get<double>();
      all.traceSeconds += root.at("seconds_trace").get<double>();
      all.peakResidentBytes = std::max(all.peakResidentBytes, root.at("peak_rss_bytes").get<double>());
    } catch (const nlohmann::json::exception&) {
      throw InputError(file.string(), "not the record of a task");
    }
  }
  return all;
}

}  // namespace promenade::app
