#pragma once
// A Slurm cluster of two nodes on this machine: a real slurmctld with two slurmd and a munged of their own.

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace promenade::e2e {

class SlurmCluster {
 public:
  /// Starts it, with a configuration, ports and a folder of its own; commands of this process and its
  /// children then speak to it. Look at reason() before use.
  SlurmCluster();
  SlurmCluster(const SlurmCluster&) = delete;
  SlurmCluster& operator=(const SlurmCluster&) = delete;
  /// Ends its jobs and itself. (Daemons end with this process, too, however it ends.)
  ~SlurmCluster();

  /// Why there is none; empty if both nodes are idle.
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  class Daemon;
  void start();

  std::filesystem::path folder_;
  std::vector<std::unique_ptr<Daemon>> daemons_;
  std::string reason_;
};

/// What a command prints on stdout; empty if it fails.
[[nodiscard]] std::string outputOf(const std::string& command);

}  // namespace promenade::e2e
