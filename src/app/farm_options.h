#pragma once
// What may be typed after `work`, `assemble` and `submit`. (`plan` takes what `render` takes.)

#include <string>

namespace promenade::app {

struct WorkOptions {
  std::string folder;
  std::string task;
  std::string threads;  ///< empty: as planned
};

struct AssembleOptions {
  std::string folder;
  std::string threads;  ///< empty: as planned
};

struct SubmitOptions {
  std::string folder;
  bool slurm = false;
  std::string partition;  ///< empty: the cluster's default
  std::string cpus;       ///< a task; empty: the cluster's default
  std::string memory;     ///< a task, as sbatch --mem takes it; empty: the cluster's default
  std::string timeLimit;  ///< a task, as sbatch --time takes it; empty: the cluster's default
  bool noWait = false;
};

}  // namespace promenade::app
