#pragma once
// The report of a job from what was kept of it.

#include "src/app/console.h"
#include "src/app/output_folder.h"
#include "src/app/preparation.h"
#include "src/app/render_job.h"
#include "src/walkthrough/report.h"

namespace promenade::app {

/// The job, its settings and what was decided for it. Statistics and seconds are left to the caller, but for
/// those of loading the job and of deciding.
[[nodiscard]] walkthrough::Report reportOf(const LoadedJob& job, const Preparation& choices, int threads);

/// Of --spp auto: a warning if the paths ran out before a viewer would have called the frames done.
void warnOfNoise(const walkthrough::Statistics& statistics, Console& console);

/// A warning if textures were decoded again for want of memory.
void warnOfTextures(const TextureUse& textures, Console& console);

/// Writes report.json and report.html, and tells the user in a line.
void writeReport(const walkthrough::Report& report, const OutputFolder& folder, Console& console);
[[nodiscard]] bool isReported(const OutputFolder& folder);

}  // namespace promenade::app
