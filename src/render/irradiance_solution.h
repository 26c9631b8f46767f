#pragma once
// A view-independent solution of the light on matt surfaces, for everything that a walk looks at. Every
// record's light is gathered by unbiased path tracing, many paths each, once for the whole walk.
// Interpolation: irradiance_records.h. Not part of the folder's public face.

#include <cstdint>
#include <functional>
#include <span>

#include "src/core/camera.h"
#include "src/core/progress.h"
#include "src/render/irradiance_records.h"
#include "src/render/path_tracer.h"

namespace promenade::render {

struct SolutionSettings {
  /// The reach of a record is this share of the harmonic mean distance to what it sees (Ward 1988) ...
  float reachOfSurroundings = 0.5f;
  /// ... but within these bounds, in display pixels at the distance it is first seen from.
  float leastReachPixels = 4.0f;
  float mostReachPixels = 20.0f;
  /// A view counts as at most this many pixels wide: larger images get no finer records.
  int mostPixelsAcross = 480;
  int pathsPerBatch = 256;
  int leastBatches = 4;
  int mostBatches = 16;
  /// Gathering ends when the standard error of a record's luminance is below this share of it.
  float relativeError = 0.02f;
  std::uint32_t seed = 0;
  std::function<void()> checkpoint = {};  ///< as in PathSettings
};

/// `cameras`: the walk's, at display resolution; the more of them, the less is left uncovered. The result
/// does not depend on the number of threads. `progress` may be empty. `rays` counts what was traced.
struct LightSolution {
  IrradianceRecords records;
  PathRays rays;
};
[[nodiscard]] LightSolution solveIrradiance(const PathTracer& tracer, std::span<const Camera> cameras,
                                            const SolutionSettings& settings,
                                            const ProgressCallback& progress);

}  // namespace promenade::render
