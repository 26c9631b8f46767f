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

void addSubmit(CLI::App& verb, SubmitOptions& o) {
  verb.add_option("folder", o.folder, "Folder of a planned job, on a file system that all machines share")
      ->required();
  verb.add_flag("--slurm", o.slurm, "To Slurm, with sbatch (the only queue that is spoken to directly)");
  verb.add_option("--partition", o.partition, "Partition of the cluster");
  verb.add_option("--cpus", o.cpus, "Processors a task");
  verb.add_option("--memory", o.memory, "Memory a task, e.g. 8G");
  verb.add_option("--time", o.timeLimit, "Time limit of a task, e.g. 2:00:00");
  verb.add_flag("--no-wait", o.noWait, "Return when the jobs are submitted");
  verb.footer("Example:\n  promenade submit walk --slurm --cpus 8");
}

}  // namespace promenade::app
