#pragma once
// A planned job as a job template of the Open Job Description, for queues other than Slurm.
// Source: Open Job Description, Template Schemas, version 2023-09.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "src/app/farm_plan.h"

namespace promenade::app {

/// Steps Prepare, Keyframes, Parts, Assemble, each after the one before. Job parameters: Folder (of the job;
/// default: where the template is) and Promenade (the program; default: found by its name).
[[nodiscard]] nlohmann::ordered_json openJobTemplate(const std::string& name, const std::vector<Task>& tasks);

}  // namespace promenade::app
