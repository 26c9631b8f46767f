#pragma once
// report.html: one file that opens in any browser without a network (docs/formats.md).

#include <optional>
#include <string>
#include <vector>

#include "src/app/rendered_job.h"
#include "src/app/report_pictures.h"
#include "src/core/progress.h"

namespace promenade::app {

/// How many times faster than ray tracing every frame, and how that is known.
struct Speedup {
  double value = 0.0;
  bool measured = false;  ///< else estimated from the samples that were ray traced
  std::string how;        ///< a sentence
};
/// Measured if `reference` (may be null) is the same job with every frame ray traced; nothing if it can be
/// neither measured nor estimated.
[[nodiscard]] std::optional<Speedup> speedupOf(const RenderedJob& job, const RenderedJob* reference);

struct ReportContents {
  Size pictureSize;
  std::vector<FramePictures> frames;
  std::optional<Speedup> speedup;
};

/// The page as text: report.json as it stands, the pictures, Chart.js, style and script. Pure.
[[nodiscard]] std::string reportPage(const RenderedJob& job, const ReportContents& contents);

/// Makes the page of the job in `folder` and writes it to `file`, whole or not at all. With `reference`, the
/// folder of another job of equal size, also what a viewer sees of the difference. Throws InputError (no
/// report.json, another size, missing or damaged frames) and CannotContinue.
void writeReportPage(const std::filesystem::path& folder,
                     const std::optional<std::filesystem::path>& reference, const std::filesystem::path& file,
                     const ProgressCallback& progress);

}  // namespace promenade::app
