#pragma once
// Progress is a callback: long work reports, the application decides what to show, and may throw Interrupted.

#include <cstdint>
#include <functional>
#include <string_view>

namespace promenade {

struct Progress {
  std::string_view what;  ///< e.g. "frames"
  std::uint64_t done = 0;
  std::uint64_t total = 0;
};

/// Called from one thread at a time. May throw Interrupted, which ends the work cleanly.
using ProgressCallback = std::function<void(const Progress&)>;

}  // namespace promenade
