#pragma once
// Runs the program as a user would and waits for it, with a time limit.

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace promenade::e2e {

[[nodiscard]] std::string contents(const std::filesystem::path& file);

struct Outcome {
  int status = -1;        ///< exit status; -1 if a signal ended the program
  int signal = 0;         ///< that signal
  bool timedOut = false;  ///< it was killed by the test
  std::string out, err;

  /// The first line on stderr that is an error.
  [[nodiscard]] std::string error() const;
};

/// A started program. Its output goes to temporary files, so that it never waits for a reader.
class Process {
 public:
  /// `prepare` runs in the child before the program begins (limits and the like).
  explicit Process(const std::vector<std::string>& arguments, const std::function<void()>& prepare = {});
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process();

  void send(int signal) const;
  [[nodiscard]] Outcome wait(std::chrono::seconds limit = std::chrono::seconds(60));

 private:
  pid_t pid_ = -1;
  std::filesystem::path out_, err_;
};

/// Starts `promenade arguments...` and waits.
[[nodiscard]] Outcome run(const std::vector<std::string>& arguments,
                          const std::function<void()>& prepare = {});

}  // namespace promenade::e2e
