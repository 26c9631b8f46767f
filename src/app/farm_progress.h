#pragma once
// How far a planned job is, seen from the files that its tasks leave. Loads nothing of the scene.

#include <filesystem>
#include <string>
#include <vector>

#include "src/app/farm_plan.h"

namespace promenade::app {

/// Numbers of the tasks that are still to be done, ascending. A shared keyframe is needed as long as one of
/// the parts beside it is not done; the preparation as long as there is a part to do. Throws InputError for
/// a file that cannot be read.
[[nodiscard]] std::vector<int> tasksToDo(const FarmPlan& plan, const std::filesystem::path& folder);

/// "3,4,7", and after twenty ",..."
[[nodiscard]] std::string listOf(const std::vector<int>& tasks);

}  // namespace promenade::app
