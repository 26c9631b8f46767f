#pragma once
// A folder that `promenade render` filled, as its report.json tells.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/app/values.h"

namespace promenade::app {

struct RenderedJob {
  std::filesystem::path folder;
  std::string report;  ///< report.json as it stands: JSON with the keys of docs/formats.md
  std::string scene;
  Size size;
  int supersample = 1;
  Frames frames{0, 0};
  double framesPerSecond = 25.0;
  bool everyFrameTraced = false;  ///< --method full
  std::string integrator;
  std::optional<int> pathsPerSample;  ///< nothing: as many as a viewer asked for
  int threads = 0;
  ToneMapping tone;
  DisplayModel display;
  double wallSeconds = 0.0;
  double speedupEstimated = 0.0;  ///< 0: unknown
  /// The judged segments in their order: frames, and the middle that was judged.
  struct Judged {
    int first, last, middle;
  };
  std::vector<Judged> segments;

  [[nodiscard]] std::filesystem::path frame(int index) const;
  /// What frame `index` was shown with.
  [[nodiscard]] FrameTone toneOf(int index) const { return tone.at(index, display); }
  /// The metric's maps of the segment; there only if the job was rendered with --maps.
  [[nodiscard]] std::filesystem::path maps(const Judged& segment) const;
};

/// Throws InputError if the folder has no report.json, or one that is not Promenade's.
[[nodiscard]] RenderedJob readRenderedJob(const std::filesystem::path& folder);

}  // namespace promenade::app
