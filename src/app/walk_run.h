#pragma once
// From a job and its renderer to frames, video and report; what an earlier run finished is not done again.

#include <functional>
#include <optional>

#include "src/app/console.h"
#include "src/app/exit_status.h"
#include "src/app/output_folder.h"
#include "src/app/preparation.h"
#include "src/app/render_job.h"

namespace promenade::app {

/// Decides what is decided once for the job before its first frame, and makes its renderer.
using PrepareWalk = std::function<PreparedJob(const OutputFolder&)>;

/// Renders the job into its folder. `given`: its parts, where they are not for Promenade's renderer to find
/// (division.h).
ExitStatus runWalk(const LoadedJob& job, const std::optional<walkthrough::Plan>& given, int threads,
                   const PrepareWalk& prepareWalk, Console& console);

}  // namespace promenade::app
