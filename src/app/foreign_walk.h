#pragma once
// Walks whose frames another renderer makes: --from (they are there) and --renderer (they are asked for).

#include "src/app/console.h"
#include "src/app/exit_status.h"
#include "src/app/options.h"

namespace promenade::app {

[[nodiscard]] bool isForeign(const RenderOptions& options);

/// Throws InputError for what render() refuses, and for frames that are missing, damaged or of another size;
/// CannotContinue if a command fails.
ExitStatus runForeignWalk(const RenderOptions& options, Console& console);

}  // namespace promenade::app
