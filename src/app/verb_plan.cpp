#include <filesystem>
#include <nlohmann/json.hpp>

#include "src/app/division.h"
#include "src/app/farm_plan.h"
#include "src/app/open_job_description.h"
#include "src/app/output_folder.h"
#include "src/app/preparation.h"
#include "src/app/render_job.h"
#include "src/app/threads.h"
#include "src/app/verbs.h"
#include "src/io/json.h"

namespace promenade::app {

ExitStatus runPlan(const RenderOptions& options, Console& console) {
  const LoadedJob job = loadJob(options);
  const OutputFolder folder(options.out, job.hash,
                            options.overwrite ? Existing::kOverwrite : Existing::kResume);
  console.keepLog(folder.file("promenade.log"), options.command);
  for (const std::string& warning : job.scene.warnings) console.warning(job.scene.source + ": " + warning);
  FarmPlan plan;
  plan.jobHash = job.hash;
  plan.workingFolder = std::filesystem::current_path();
  plan.arguments = argumentsOf(options);
  const ThreadLimit threads(job.values.threads);
  std::optional<Division> division = divisionIn(folder, job.hash);
  if (!division) division = divide(job, *rendererOf(job, nullptr, threads.count()), folder, console);
  plan.tasks = tasksOf(division->parts);
  writePlan(folder.file("plan.json"), plan);
  io::writeJson(folder.file("template.openjd.json"), openJobTemplate(job.path.name, plan.tasks));

  std::string text = options.out + ": " + std::to_string(plan.tasks.size()) + " tasks\n";
  for (const Stage& stage : stagesOf(plan.tasks)) {
    const auto taskAt = [&](int k) { return describe(plan.tasks[static_cast<std::size_t>(k)]); };
    const int last = stage.first + stage.count - 1;
    text.append("  ").append(std::to_string(stage.first));
    if (stage.count > 1) text.append("-").append(std::to_string(last));
    text.append(": ").append(taskAt(stage.first));
    if (stage.count > 1) text.append(" and on to ").append(taskAt(last));
    text.append("\n");
  }
  console.result(text);
  return ExitStatus::kDone;
}

}  // namespace promenade::app
