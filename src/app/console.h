#pragma once
// What the user sees: results on stdout, notices and progress on stderr.

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
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

/// Standard error is a terminal that shows colours, and NO_COLOR does not say otherwise.
[[nodiscard]] bool coloursOnStderr();

class Console {
 public:
  /// Throws InputError for an unknown log level.
  explicit Console(const ConsoleOptions& options);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  /// A result: one or more lines on stdout. Nothing happens if stdout is a pipe whose reader has gone;
  /// throws CannotContinue if it cannot take it for another reason.
  void result(const std::string& text);
  void info(const std::string& line);
  void warning(const std::string& line);
  /// Into the log file only: what ends the program is said on stderr by main().
  void logError(const std::string& line);

  /// From now on notices, warnings, and progress twice a minute also go to the end of this file, with the
  /// time, whatever
  /// --quiet and --log-level say; first `command`. Throws InputError if the file cannot be opened. A disk
  /// that is full later does not end the work.
  void keepLog(const std::filesystem::path& file, const std::string& command);

  /// Shows what is reported, a bar on a terminal, else a line every few seconds; throws Interrupted when the
  /// user asked to stop. The console must outlive the callback. `secondsLeft` (may be empty) knows more of
  /// the time that is left than the rate tells.
  [[nodiscard]] ProgressCallback progress(std::function<std::optional<double>()> secondsLeft = {});
  /// Ends a bar with a newline; call when the work is done. (The destructor does too.)
  void endProgress();

 private:
  using Clock = std::chrono::steady_clock;
  void show(const Progress& progress, std::optional<double> secondsLeft);
  void clearBar();

  std::shared_ptr<spdlog::logger> log_;
  std::shared_ptr<spdlog::logger> file_;  ///< none before keepLog()
  bool showsProgress_ = true;
  bool terminal_ = false;
  bool barOnScreen_ = false;
  std::string what_;
  Clock::time_point start_;
  Clock::time_point lastShown_;
  Clock::time_point lastLogged_;
};

}  // namespace promenade::app
