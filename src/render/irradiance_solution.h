#pragma once
// A view-independent solution of the light on matt surfaces, for everything that a walk looks at, solved once
// for the whole walk. Interpolation: irradiance_records.h.
//
// 1. Coarse records cover what the cameras see and what light bounces off on its way there. Their light is
//    gathered by path tracing with few paths, then again, with paths that end at the first surface that the
//    last result knows and that is far enough away: the errors of single records average out over the
//    hemisphere. They serve for bounces only.
// 2. Fine records for what the cameras see are gathered with paths that end at the coarse ones (final
//    gathering), level by level: each level half as far apart, where nothing reaches, or where the light
//    that the records around a place say is there differs by more than a viewer should see.
//
// Records are close enough that most of a record's noise can be told from light by its neighbours
// (irradiance_records.h). Where records are does not depend on the seed. Not part of the folder's public
// face.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "src/core/camera.h"
#include "src/core/progress.h"
#include "src/render/irradiance_records.h"
#include "src/render/path_tracer.h"

namespace promenade::render {

/// How far apart records may be. The reach of a record is at most a share of the harmonic mean distance to
/// what it sees (Ward 1988), and within bounds in display pixels at the distance it is first seen from.
struct RecordSpacing {
  float reachOfSurroundings;
  float leastReachPixels;
  float mostReachPixels;
};

struct SolutionSettings {
  RecordSpacing coarse = {0.5f, 8.0f, 40.0f};
  RecordSpacing fine = {0.5f, 4.0f, 20.0f};
  /// A view counts as at most this many pixels wide: larger images get no finer records.
  int mostPixelsAcross = 480;
  /// Records that differ by more than this share of their light get finer ones between them. Light below
  /// `darkness` times the mean of all records is measured against that instead.
  float disagreement = 0.05f;
  float darkness = 0.1f;

  int coarsePaths = 128;  ///< per record, until it is known how noisy they are
  /// ... in the last pass, unless they are noisy. What all have too much or too little of moves the whole
  /// picture.
  int lastCoarsePaths = 256;
  /// Where the standard error of the coarse records (of coarsePaths) is more than this share of their light
  /// on average, bright surfaces are looked for and sampled as lights (bright_surfaces.h): a room lit by way
  /// of a patch of sun has 0.13, a hall under windows 0.05 and nothing to gain.
  double noisy = 0.08;
  /// Per coarse record of such a scene in the last pass, less before. The errors of coarse records do not
  /// average out where few of them send most of the light: then they move the whole picture.
  int noisyCoarsePaths = 1024;
  /// Of a fine record. Its light by direction needs the paths that begin, even where the light as a whole is
  /// clean with fewer.
  GatherEffort fineEffort = {.paths = 1024, .points = 1024, .most = 4096, .relativeError = 0.015f};
  std::uint32_t seed = 0;
  std::function<void()> checkpoint = {};  ///< as in PathSettings
};

struct LightSolution {
  IrradianceRecords coarse;  ///< for bounces
  IrradianceRecords fine;    ///< for what is seen
  PathRays rays;
  std::vector<std::uint64_t> cameras;  ///< fingerprints of those it was made for

  [[nodiscard]] bool isFor(const Camera& camera) const;
  /// Nothing where neither knows.
  [[nodiscard]] std::optional<SurfaceLight> at(const glm::vec3& position, const glm::vec3& normal) const;
  /// ... from single records: for light that many paths bring together, from there to a place at that
  /// `distance`. Nothing where a coarse record reaches so far that it would blur what the place sees: beside
  /// the edge of a room, how its other wall darkens toward the edge.
  [[nodiscard]] std::optional<SurfaceLight> roughlyAt(const glm::vec3& position, const glm::vec3& normal,
                                                      float distance) const;
};

/// Makes a solution level by level, each with records half as far apart as the one before. The first also
/// makes the coarse records, the dearest part of a solution of few cameras. The result depends neither on the
/// number of threads nor on interruptions.
class IrradianceSolver {
 public:
  /// `known`: as for solveLight(). `cameras`: the walk's, at display resolution; the more of them, the less
  /// is left uncovered. `tracer` and `settings` must outlive this; the tracer gets the solution.
  IrradianceSolver(PathTracer& tracer, std::span<const Camera> cameras, const SolutionSettings& settings,
                   const std::shared_ptr<const LightSolution>& known);

  [[nodiscard]] int levelsLeft() const;
  [[nodiscard]] bool isDone() const { return levelsLeft() == 0; }
  /// Places the records of the next level, if that is not done yet. Returns the least number of paths that
  /// gathering their light will take.
  std::uint64_t place();
  /// Finishes the next level. `progress` and `mayTrace` may be empty (path_renderer.h). If the checkpoint or
  /// `progress` throws, the solution stays what it was, and a later call makes the whole level.
  void gather(const ProgressCallback& progress, const MayTrace& mayTrace);
  /// As far as it is known. Records without light may be in it, which are nothing to whoever looks there. For
  /// the cameras only when it is done (LightSolution::isFor()). Its `rays` are those that were traced here.
  [[nodiscard]] const LightSolution& solution() const { return solution_; }
  [[nodiscard]] LightSolution take() && { return std::move(solution_); }

 private:
  class Gatherer;
  [[nodiscard]] bool isFirst() const;
  void placeCoarse();
  void gatherCoarse(Gatherer& gatherer, const MayTrace& mayTrace);

  PathTracer& tracer_;
  const SolutionSettings& settings_;
  std::shared_ptr<const LightSolution> known_;
  LightSolution solution_;
  std::vector<Camera> added_;
  std::size_t coarseBefore_ = 0;  ///< records that were known before
  std::size_t fineBefore_ = 0;    ///< ... before the next level
  int stride_ = 0;                ///< of the next level, display pixels; 0: there is none
  bool isPlaced_ = false;         ///< the records of the next level
  bool isNoisy_ = false;          ///< the coarse records stayed noisier than they should be
};

}  // namespace promenade::render
