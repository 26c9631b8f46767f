#pragma once
// The parts that a job is rendered in. Found once, for they decide what is traced and what is warped; kept in
// DIR/division.json, so that a job that goes on, here or on another machine, has the same.

#include <optional>
#include <string>

#include "src/app/console.h"
#include "src/app/output_folder.h"
#include "src/app/render_job.h"
#include "src/core/renderer.h"
#include "src/walkthrough/walkthrough.h"

namespace promenade::app {

struct Division {
  walkthrough::Plan parts;
  double seconds = 0.0;  ///< that it took to find them
};

/// What was found before for this job.
[[nodiscard]] std::optional<Division> divisionIn(const OutputFolder& folder, const std::string& jobHash);

/// Finds walkthrough::partsOf() the job, and keeps them.
[[nodiscard]] Division divide(const LoadedJob& job, const Renderer& renderer, const OutputFolder& folder,
                              Console& console);

}  // namespace promenade::app
