#pragma once
// The end of the threads that work is spread over.

#include <tbb/global_control.h>

#include <new>

namespace promenade {

/// Ends TBB's worker threads, and waits for them, when it is destroyed. Without it they are detached as the
/// process ends, and what they give back races with the destruction of libraries' static objects. One object,
/// in main(), made before anything runs in parallel.
class WorkerThreads {
 public:
  WorkerThreads() = default;
  WorkerThreads(const WorkerThreads&) = delete;
  WorkerThreads& operator=(const WorkerThreads&) = delete;
  ~WorkerThreads() { tbb::finalize(handle_, std::nothrow); }

 private:
  tbb::task_scheduler_handle handle_{tbb::attach{}};
};

}  // namespace promenade
