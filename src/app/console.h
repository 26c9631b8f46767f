#pragma once
// What the user sees: results on stdout, notices and progress on stderr.

#include <chrono>
#include <memory>
#include <string>

#include "src/core/progress.h"

namespace spdlog {
class logger;
}

namespace promenade::app {

struct ConsoleOptions {
  bool quiet = false;             ///< neither progress nor notices
  std::string logLevel = "info";  ///< trace, debug, info, warning, error, critical, off
};

class Console {
 public:
  /// Throws InputError for an unknown log level.
  explicit Console(const ConsoleOptions& options);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  /// A result: one or more lines on stdout. Throws CannotContinue if stdout cannot take it.
  void result(const std::string& text);
  void info(const std::string& line);
  void warning(const std::string& line);

  /// Shows what is reported, a bar on a terminal, else a line every few seconds; throws Interrupted when the
  /// user asked to stop. The console must outlive the callback.
  [[nodiscard]] ProgressCallback progress();
  /// Ends a bar with a newline; call when the work is done. (The destructor does too.)
  void endProgress();

 private:
  using Clock = std::chrono::steady_clock;
  void show(const Progress& progress);
  void clearBar();

  std::shared_ptr<spdlog::logger> log_;
  bool showsProgress_ = true;
  bool terminal_ = false;
  bool barOnScreen_ = false;
  std::string what_;
  Clock::time_point start_;
  Clock::time_point lastShown_;
};

}  // namespace promenade::app
