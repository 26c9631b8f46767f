#include "src/app/interrupt.h"

#include <atomic>
#include <csignal>

#include "src/core/errors.h"

namespace promenade::app {
namespace {

std::atomic<bool> stopRequested{false};
static_assert(std::atomic<bool>::is_always_lock_free,
              "only lock-free atomics may be used in signal handlers");

extern "C" void requestStop(int) {
  stopRequested.store(true);
}

}  // namespace

void installInterruptHandlers() {
  struct sigaction action = {};
  action.sa_handler = requestStop;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // Writing past a file size limit or into a closed pipe shall be an error that is reported, not the end.
  action.sa_handler = SIG_IGN;
  action.sa_flags = 0;
  sigaction(SIGXFSZ, &action, nullptr);
  sigaction(SIGPIPE, &action, nullptr);
}

void throwIfInterrupted() {
  if (stopRequested.load()) throw Interrupted();
}

}  // namespace promenade::app
