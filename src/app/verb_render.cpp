#include "src/app/foreign_walk.h"
#include "src/app/preparation.h"
#include "src/app/preview_run.h"
#include "src/app/render_job.h"
#include "src/app/threads.h"
#include "src/app/verbs.h"
#include "src/app/walk_run.h"

namespace promenade::app {

ExitStatus runRender(const RenderOptions& options, Console& console) {
  if (!options.preview.empty()) return runPreview(options, console);
  if (isForeign(options)) return runForeignWalk(options, console);
  const ThreadLimit threads(renderValues(options).threads);
  const LoadedJob job = loadJob(options);
  const auto prepared = [&](const OutputFolder& folder) {
    return prepare(job, folder, threads.count(), console);
  };
  return runWalk(job, std::nullopt, threads.count(), prepared, console);
}

}  // namespace promenade::app
