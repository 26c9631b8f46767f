#pragma once

#include <chrono>

namespace promenade::app {

using Clock = std::chrono::steady_clock;

/// Of wall time.
[[nodiscard]] inline double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace promenade::app
