#pragma once

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <optional>

namespace promenade::app {

/// While it lives, parallel work uses at most so many threads; 0: all there are.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads) : count_(threads > 0 ? threads : tbb::info::default_concurrency()) {
    limit_.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count_));
  }
  [[nodiscard]] int count() const { return count_; }

 private:
  int count_;
  std::optional<tbb::global_control> limit_;
};

}  // namespace promenade::app
