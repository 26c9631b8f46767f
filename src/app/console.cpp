#include "src/app/console.h"

#include <spdlog/logger.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>

#include "src/app/interrupt.h"
#include "src/app/printable.h"
#include "src/app/progress_line.h"
#include "src/core/errors.h"
#include "src/core/nearest_name.h"

namespace promenade::app {
namespace {

constexpr std::chrono::milliseconds kBarInterval{100};
constexpr std::chrono::seconds kLineInterval{5};
constexpr std::chrono::seconds kLogInterval{30};
constexpr std::array<std::string_view, 7> kLevels = {"trace", "debug",    "info", "warning",
                                                     "error", "critical", "off"};

int terminalColumns() {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return size.ws_col;
}

spdlog::level::level_enum levelOf(const std::string& name) {
  for (const std::string_view known : kLevels) {
    if (name == known) return spdlog::level::from_str(name);
  }
  throw InputError("--log-level: unknown level '" + printable(name) + "'; did you mean '" +
                   nearestName(name, kLevels) + "'?");
}

}  // namespace

bool coloursOnStderr() {
  const char* unwanted = std::getenv("NO_COLOR");  // https://no-color.org
  const char* terminal = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && (unwanted == nullptr || *unwanted == '\0') && terminal != nullptr &&
         std::string_view(terminal) != "dumb";
}

Console::Console(const ConsoleOptions& options)
    : log_(std::make_shared<spdlog::logger>(
          "promenade", std::make_shared<spdlog::sinks::stderr_color_sink_mt>(
                           coloursOnStderr() ? spdlog::color_mode::always : spdlog::color_mode::never))),
      showsProgress_(!options.quiet),
      terminal_(isatty(STDERR_FILENO) == 1) {
  const auto level = levelOf(options.logLevel);
  log_->set_level(options.quiet ? std::max(level, spdlog::level::err) : level);
  log_->set_pattern("promenade: %^%l%$: %v");
  showsProgress_ = showsProgress_ && level <= spdlog::level::info;
}

Console::~Console() {
  endProgress();
}

void Console::result(const std::string& text) {
  clearBar();
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return;
  // A reader that has seen enough (`| head`) is no failure, neither of the work nor of the verdict.
  if (errno != EPIPE) throw CannotContinue("standard output: cannot write");
}

void Console::info(const std::string& line) {
  clearBar();
  log_->info(printable(line));
  if (file_) file_->info(printable(line));
}

void Console::warning(const std::string& line) {
  clearBar();
  log_->warn(printable(line));
  if (file_) file_->warn(printable(line));
}

void Console::logError(const std::string& line) {
  if (file_) file_->error(printable(line));
}

void Console::keepLog(const std::filesystem::path& file, const std::string& command) {
  try {
    file_ =
        std::make_shared<spdlog::logger>("file", std::make_shared<spdlog::sinks::basic_file_sink_mt>(file));
  } catch (const spdlog::spdlog_ex& error) {
    throw InputError(file.string(), "cannot be written: " + std::string(error.what()));
  }
  file_->set_error_handler([](const std::string&) {});
  file_->set_pattern("%Y-%m-%d %H:%M:%S %l: %v");
  file_->flush_on(spdlog::level::info);
  file_->info(std::string("promenade ") + PROMENADE_VERSION + ": " + printable(command));
}

ProgressCallback Console::progress(std::function<std::optional<double>()> secondsLeft) {
  return [this, secondsLeft = std::move(secondsLeft)](const Progress& progress) {
    throwIfInterrupted();
    show(progress, secondsLeft ? secondsLeft() : std::nullopt);
  };
}

void Console::show(const Progress& progress, std::optional<double> secondsLeft) {
  const auto now = Clock::now();
  if (what_ != progress.what) {
    endProgress();
    what_ = progress.what;
    start_ = now;
    lastShown_ = now;
    lastLogged_ = now;
    if (terminal_) lastShown_ -= kBarInterval;
  }
  const bool last = progress.done == progress.total;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  if (file_ && (last || now - lastLogged_ >= kLogInterval)) {
    file_->info(progressLine(progress, elapsed, secondsLeft));
    lastLogged_ = now;
  }
  if (!showsProgress_) return;
  if (now - lastShown_ < (terminal_ ? Clock::duration(kBarInterval) : Clock::duration(kLineInterval)) &&
      !last)
    return;
  lastShown_ = now;
  if (terminal_) {
    std::fprintf(stderr, "\r%s\x1b[K",
                 progressBar(progress, elapsed, terminalColumns(), secondsLeft).c_str());
    barOnScreen_ = true;
  } else {
    std::fprintf(stderr, "%s\n", progressLine(progress, elapsed, secondsLeft).c_str());
  }
  std::fflush(stderr);
}

void Console::clearBar() {
  if (!barOnScreen_) return;
  std::fputs("\r\x1b[K", stderr);
  barOnScreen_ = false;
}

void Console::endProgress() {
  if (barOnScreen_) std::fputc('\n', stderr);
  barOnScreen_ = false;
  what_.clear();
}

}  // namespace promenade::app
