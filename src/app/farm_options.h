#pragma once
// What may be typed after `work` and `assemble`. (`plan` takes what `render` takes.)

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

}  // namespace promenade::app
