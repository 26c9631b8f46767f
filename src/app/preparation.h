#pragma once
// What is decided once for a job before its first frame: the light solution and the tone mapping. Kept in
// DIR/prepared.json, so that a job that goes on never decides twice.

#include <memory>
#include <optional>
#include <string>

#include "src/app/console.h"
#include "src/app/output_folder.h"
#include "src/app/render_job.h"
#include "src/core/renderer.h"
#include "src/render/path_renderer.h"
#include "src/walkthrough/report.h"

namespace promenade::app {

/// The light solution that a job uses.
struct LightUse {
  std::string fingerprint;  ///< of its file
  walkthrough::LightReport report;
};

struct Preparation {
  std::optional<LightUse> light;  ///< nothing: none is used
  ToneMapping tone;
  double secondsIndirect = 0.0;
  double secondsChoosing = 0.0;
};

struct PreparedJob {
  Preparation choices;
  std::unique_ptr<Renderer> renderer;
  double secondsBuilding = 0.0;  ///< of the renderer
};

/// Traces the job's scene; without `solution` by paths alone. `job` must outlive it.
[[nodiscard]] std::unique_ptr<Renderer> rendererOf(const LoadedJob& job,
                                                   std::shared_ptr<const render::LightSolution> solution,
                                                   int threads);

/// Ready to render. The choices are those of DIR/prepared.json if it is of this job, else they are made and
/// written there. Throws InputError if the file of the light solution is not the one the job began with: the
/// frames would not fit together. `job` must outlive the renderer.
[[nodiscard]] PreparedJob prepare(const LoadedJob& job, const OutputFolder& folder, int threads,
                                  Console& console);

/// What an earlier run of the job decided; without the view of the tone, which is the job's own.
[[nodiscard]] std::optional<Preparation> preparationIn(const OutputFolder& folder,
                                                       const std::string& jobHash);

}  // namespace promenade::app
