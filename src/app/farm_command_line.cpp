#include "src/app/farm_command_line.h"

namespace promenade::app {

void addWork(CLI::App& verb, WorkOptions& o) {
  verb.add_option("folder", o.folder, "Folder of a planned job")->required();
  verb.add_option("--task", o.task, "Number of the task in the plan, from 0")->required();
  verb.add_option("--threads", o.threads, "Threads, 0: all (default: as planned)");
  verb.footer("Example:\n  promenade work walk --task 3");
}

void addAssemble(CLI::App& verb, AssembleOptions& o) {
  verb.add_option("folder", o.folder, "Folder of a planned job whose tasks are done")->required();
  verb.add_option("--threads", o.threads, "Threads, 0: all (default: as planned)");
  verb.footer("Example:\n  promenade assemble walk");
}

}  // namespace promenade::app
