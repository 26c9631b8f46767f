#pragma once
// How progress reads. Pure, so that it can be tested.

#include <optional>
#include <string>

#include "src/core/progress.h"

namespace promenade::app {

/// "frames 12/200  6%  3.1/s  1m 01s left"; without rate and time left as long as nothing is done.
/// `secondsLeft` where more is known than the rate tells.
[[nodiscard]] std::string progressLine(const Progress& progress, double elapsedSeconds,
                                       std::optional<double> secondsLeft = {});

/// The same with a bar, for a terminal of `columns`.
[[nodiscard]] std::string progressBar(const Progress& progress, double elapsedSeconds, int columns,
                                      std::optional<double> secondsLeft = {});

/// "59s", "1m 01s", "2h 03m"
[[nodiscard]] std::string duration(double seconds);

}  // namespace promenade::app
