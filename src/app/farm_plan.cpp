#include "src/app/farm_plan.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

#include "src/app/printable.h"
#include "src/core/errors.h"
#include "src/io/json.h"

namespace promenade::app {
namespace {

constexpr const char* kKindNames[] = {"prepare", "keyframe", "part"};

const char* nameOf(TaskKind kind) {
  return kKindNames[static_cast<int>(kind)];
}

Task taskFrom(const nlohmann::json& value) {
  const std::string name = value.at("kind");
  const auto* kind = std::find(std::begin(kKindNames), std::end(kKindNames), name);
  if (kind == std::end(kKindNames))
    throw InputError("plan.json: unknown kind of task '" + printable(name) + "'");
  return {static_cast<TaskKind>(kind - std::begin(kKindNames)),
          {value.value("first", 0), value.value("last", 0), 0}};
}

}  // namespace

std::vector<Task> tasksOf(const walkthrough::Plan& parts) {
  std::vector<Task> tasks{{TaskKind::kPrepare, {}}};
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const int shared = parts[i].first;
    if (parts[i - 1].last == shared) tasks.push_back({TaskKind::kKeyframe, {shared, shared, 0}});
  }
  for (const walkthrough::Segment& part : parts) tasks.push_back({TaskKind::kPart, part});
  return tasks;
}

std::vector<Stage> stagesOf(const std::vector<Task>& tasks) {
  std::vector<Stage> stages;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (stages.empty() || stages.back().kind != tasks[i].kind) {
      stages.push_back({tasks[i].kind, static_cast<int>(i), 0});
    }
    ++stages.back().count;
  }
  return stages;
}

std::set<int> sharedKeyframes(const std::vector<Task>& tasks) {
  std::set<int> frames;
  for (const Task& task : tasks) {
    if (task.kind == TaskKind::kKeyframe) frames.insert(task.part.first);
  }
  return frames;
}

std::string describe(const Task& task) {
  switch (task.kind) {
    case TaskKind::kPrepare:
      return "light and exposure";
    case TaskKind::kKeyframe:
      return "keyframe " + std::to_string(task.part.first);
    case TaskKind::kPart:
      return "frames " + std::to_string(task.part.first) + " to " + std::to_string(task.part.last);
  }
  return {};
}

std::vector<std::string> argumentsOf(const RenderOptions& options) {
  static constexpr std::string_view kOfThisRun[] = {"out",    "resume", "overwrite",
                                                    "config", "quiet",  "log-level"};
  std::vector<std::string> arguments{options.scene};
  for (const auto& [name, value] : options.all) {
    if (std::find(std::begin(kOfThisRun), std::end(kOfThisRun), name) != std::end(kOfThisRun)) continue;
    arguments.push_back("--" + name + "=" + value);
  }
  return arguments;
}

void writePlan(const std::filesystem::path& file, const FarmPlan& plan) {
  nlohmann::ordered_json tasks = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
    const Task& task = plan.tasks[i];
    nlohmann::ordered_json entry = {{"task", i}, {"kind", nameOf(task.kind)}};
    if (task.kind != TaskKind::kPrepare) {
      entry["first"] = task.part.first;
      entry["last"] = task.part.last;
    }
    tasks.push_back(std::move(entry));
  }
  io::writeJson(file, nlohmann::ordered_json{{"version", PROMENADE_VERSION},
                                             {"job", plan.jobHash},
                                             {"working_folder", plan.workingFolder.string()},
                                             {"arguments", plan.arguments},
                                             {"tasks", std::move(tasks)}});
}

FarmPlan readPlan(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) {
    throw InputError(file.string(), "no such file; `promenade plan` writes it");
  }
  const nlohmann::json root = io::readJson(file);
  try {
    FarmPlan plan;
    plan.jobHash = root.at("job");
    plan.workingFolder = root.at("working_folder").get<std::string>();
    plan.arguments = root.at("arguments").get<std::vector<std::string>>();
    for (const nlohmann::json& task : root.at("tasks")) plan.tasks.push_back(taskFrom(task));
    return plan;
  } catch (const nlohmann::json::exception&) {
    throw InputError(file.string(), "not a plan of this version of the program");
  }
}

}  // namespace promenade::app
