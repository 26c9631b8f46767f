#include "src/app/progress_line.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "src/app/formatted.h"

namespace promenade::app {

std::string duration(double seconds) {
  const auto s = static_cast<long long>(std::llround(std::clamp(seconds, 0.0, 1e9)));
  if (s < 60) return formatted("%llds", s);
  if (s < 3600) return formatted("%lldm %02llds", s / 60, s % 60);
  return formatted("%lldh %02lldm", s / 3600, s % 3600 / 60);
}

std::string progressLine(const Progress& progress, double elapsedSeconds, std::optional<double> secondsLeft) {
  const double done = static_cast<double>(progress.done);
  const double total = static_cast<double>(progress.total);
  std::string line = std::string(progress.what) +
                     formatted(" %llu/%llu  %.0f%%", static_cast<unsigned long long>(progress.done),
                               static_cast<unsigned long long>(progress.total),
                               total > 0.0 ? std::floor(100.0 * done / total) : 100.0);
  if (progress.done == 0 || elapsedSeconds <= 0.0) return line;
  const double rate = done / elapsedSeconds;
  line += rate >= 1.0 ? formatted("  %.1f/s", rate) : formatted("  %.1fs each", 1.0 / rate);
  if (progress.done < progress.total) {
    line += "  " + duration(secondsLeft.value_or((total - done) / rate)) + " left";
  }
  return line;
}

std::string progressBar(const Progress& progress, double elapsedSeconds, int columns,
                        std::optional<double> secondsLeft) {
  const std::string line = progressLine(progress, elapsedSeconds, secondsLeft);
  const int width = std::clamp(columns - static_cast<int>(line.size()) - 5, 0, 40);
  if (width < 8) return line.substr(0, static_cast<std::size_t>(std::max(columns - 1, 0)));
  const double share =
      progress.total > 0 ? static_cast<double>(progress.done) / static_cast<double>(progress.total) : 1.0;
  const int filled = static_cast<int>(std::clamp(share, 0.0, 1.0) * width);
  std::string bar("[");
  bar.append(static_cast<std::size_t>(filled), '#');
  bar.append(static_cast<std::size_t>(width - filled), '.');
  return bar + "] " + line;
}

}  // namespace promenade::app
