#pragma once
// The report of a run as text: report.json (docs/formats.md lists its keys). Pure.

#include <cstdint>
#include <string>

#include "src/core/display.h"
#include "src/walkthrough/walkthrough.h"

namespace promenade::walkthrough {

/// What was asked for, as far as `Settings` does not say it.
struct JobDescription {
  std::string scene;
  std::string path;
  double framesPerSecond = 25.0;
  std::string integrator;
  std::string light;  ///< "scene", "sky" or the environment's file
  int pathsPerSample = 0;
  bool pathsChosenAutomatically = false;
  std::uint64_t seed = 0;
  int threads = 0;
};

/// Wall seconds of the parts that renderWalkthrough() does not know of.
struct OutsideSeconds {
  double load = 0.0;      ///< scene, path, acceleration structures
  double indirect = 0.0;  ///< a baked indirect solution
  double prepare = 0.0;   ///< choosing exposure and paths a sample
  double encode = 0.0;    ///< video
  double write = 0.0;     ///< frames and maps
};

struct Report {
  std::string version;
  JobDescription job;
  Settings settings;
  Statistics statistics;
  OutsideSeconds seconds;
  double wallSeconds = 0.0;
  double peakResidentBytes = 0.0;
  /// Frames before this one were there from an earlier run of the job and are not in the statistics.
  int resumedFrom = 0;
};

[[nodiscard]] std::string reportJson(const Report& report);

}  // namespace promenade::walkthrough
