#include "src/app/open_job_description.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "src/app/printable.h"

namespace promenade::app {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson scriptOf(const OrderedJson& arguments) {
  return {{"actions", {{"onRun", {{"command", "{{Param.Promenade}}"}, {"args", arguments}}}}}};
}

OrderedJson stepOf(const Stage& stage) {
  OrderedJson step = {{"name", stage.kind == TaskKind::kPrepare    ? "Prepare"
                               : stage.kind == TaskKind::kKeyframe ? "Keyframes"
                                                                   : "Parts"}};
  std::string range = std::to_string(stage.first);
  if (stage.count > 1) range.append("-").append(std::to_string(stage.first + stage.count - 1));
  step["parameterSpace"] = {{"taskParameterDefinitions",
                             OrderedJson::array({{{"name", "Task"}, {"type", "INT"}, {"range", range}}})}};
  step["script"] = scriptOf({"work", "{{Param.Folder}}", "--task", "{{Task.Param.Task}}"});
  return step;
}

// <JobName>: no control characters, no format string, at most 128 characters.
std::string jobName(const std::string& walk) {
  std::string name = "Promenade";
  if (!walk.empty()) name.append(" ").append(printable(walk));
  std::replace(name.begin(), name.end(), '{', '(');
  return name.substr(0, 100);
}

}  // namespace

OrderedJson openJobTemplate(const std::string& name, const std::vector<Task>& tasks) {
  OrderedJson steps = OrderedJson::array();
  for (const Stage& stage : stagesOf(tasks)) steps.push_back(stepOf(stage));
  steps.push_back({{"name", "Assemble"}, {"script", scriptOf({"assemble", "{{Param.Folder}}"})}});
  for (std::size_t i = 1; i < steps.size(); ++i) {
    steps[i]["dependencies"] = OrderedJson::array({{{"dependsOn", steps[i - 1]["name"]}}});
  }
  return {{"specificationVersion", "jobtemplate-2023-09"},
          {"name", jobName(name)},
          {"parameterDefinitions",
           OrderedJson::array({{{"name", "Folder"},
                                {"type", "PATH"},
                                {"objectType", "DIRECTORY"},
                                {"dataFlow", "INOUT"},
                                {"default", "."},
                                {"description", "The planned job; all machines must see it"}},
                               {{"name", "Promenade"},
                                {"type", "STRING"},
                                {"default", "promenade"},
                                {"description", "The program"}}})},
          {"steps", std::move(steps)}};
}

}  // namespace promenade::app
