#include "src/app/farm_progress.h"

#include <algorithm>
#include <set>

#include "src/app/output_folder.h"
#include "src/app/part_records.h"
#include "src/app/preparation.h"

namespace promenade::app {
namespace {

walkthrough::FrameRange walkOf(const std::vector<Task>& tasks) {
  walkthrough::FrameRange walk{0, -1};
  bool isFirst = true;
  for (const Task& task : tasks) {
    if (task.kind != TaskKind::kPart) continue;
    if (isFirst) walk.first = task.part.first;
    isFirst = false;
    walk.last = task.part.last;
  }
  return walk;
}

}  // namespace

std::vector<int> tasksToDo(const FarmPlan& plan, const std::filesystem::path& folder) {
  const OutputFolder files(folder, plan.jobHash, Existing::kShare);
  const PartRecords records(files, plan.jobHash, walkOf(plan.tasks));
  std::vector<int> missing;
  std::set<int> ends;  // first and last frames of the parts that are missing
  for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
    const walkthrough::Segment& part = plan.tasks[i].part;
    if (plan.tasks[i].kind != TaskKind::kPart || records.find(part)) continue;
    missing.push_back(static_cast<int>(i));
    ends.insert({part.first, part.last});
  }
  const bool isPrepared = preparationIn(files, plan.jobHash).has_value();
  for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
    const Task& task = plan.tasks[i];
    const bool isMissing = (task.kind == TaskKind::kPrepare && !isPrepared) ||
                           (task.kind == TaskKind::kKeyframe && ends.contains(task.part.first) &&
                            !std::filesystem::is_regular_file(files.keyframe(task.part.first)));
    if (isMissing) missing.push_back(static_cast<int>(i));
  }
  std::sort(missing.begin(), missing.end());
  return missing;
}

std::string listOf(const std::vector<int>& tasks) {
  constexpr std::size_t kMost = 20;
  std::string list;
  for (std::size_t i = 0; i < std::min(tasks.size(), kMost); ++i) {
    if (i > 0) list.append(",");
    list.append(std::to_string(tasks[i]));
  }
  if (tasks.size() > kMost) list += ",...";
  return list;
}

}  // namespace promenade::app
