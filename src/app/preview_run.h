#pragma once
// `promenade render --preview SECONDS`: one picture, DIR/preview.exr (as the frames of a walk are) and
// DIR/preview.png, whatever else is in the folder. Nothing of it is used by a later run.

#include "src/app/console.h"
#include "src/app/exit_status.h"
#include "src/app/options.h"

namespace promenade::app {

/// Throws InputError, too, for options that are about a walk.
ExitStatus runPreview(const RenderOptions& options, Console& console);

}  // namespace promenade::app
