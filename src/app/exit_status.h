#pragma once

namespace promenade::app {

/// What the shell gets back.
enum class ExitStatus {
  kDone = 0,
  kDifferenceAboveLimit = 1,  ///< compare --fail-above
  kBadInput = 2,              ///< InputError, usage
  kCannotContinue = 3,        ///< disk full, out of memory
  kInterrupted = 130,         ///< Ctrl-C
};

}  // namespace promenade::app
