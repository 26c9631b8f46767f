#pragma once
// The report of a run as text: report.json (docs/formats.md lists its keys). Pure.

#include <cstdint>
#include <optional>
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
  std::string light;                  ///< "scene", "sky" or the environment's file
  std::optional<int> pathsPerSample;  ///< nothing: as many as a viewer asks for
  std::uint64_t seed = 0;
  int threads = 0;
  std::string command;    ///< what repeats the job, for a shell
  std::string directory;  ///< where it was given
};

/// The view-independent solution of the light on matt surfaces that a run used.
struct LightReport {
  std::string file;
  std::uint64_t records = 0;
  std::uint64_t recordsAdded = 0;  ///< by this run; the others were in the file
  std::uint64_t cameras = 0;       ///< that it was made for, of this walk and of others
  std::uint64_t rays = 0;          ///< that this run traced for it
};

/// Wall seconds of the parts that renderWalkthrough() does not know of.
struct OutsideSeconds {
  double load = 0.0;      ///< scene, path, acceleration structures
  double indirect = 0.0;  ///< a baked indirect solution
  double prepare = 0.0;   ///< choosing the exposure
  double plan = 0.0;      ///< placing keyframes
  double encode = 0.0;    ///< video
  double write = 0.0;     ///< frames and maps
};

struct Report {
  std::string version;
  JobDescription job;
  Settings settings;
  Statistics statistics;
  OutsideSeconds seconds;
  std::optional<LightReport> light;  ///< nothing: paths alone
  double wallSeconds = 0.0;
  double peakResidentBytes = 0.0;
  TextureUse textures;  ///< of the run that made the report
};

/// How many times longer every frame ray traced would have taken: what the keyframes took a sample, times all
/// samples, with the same loading, light solution, filtering and output, over the wall time. 0 where there is
/// no keyframe to go by.
[[nodiscard]] double estimatedSpeedup(const Report& report);

[[nodiscard]] std::string reportJson(const Report& report);

}  // namespace promenade::walkthrough
