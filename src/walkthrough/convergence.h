#pragma once
// How fast does the picture of a solution become, to a viewer, that of the converged one? The course notes
// call this perceptual convergence, as opposed to physical: Chalmers, Daly, McNamara, Myszkowski, Troscianko
// 2000, section 4.3.1, figures 4.4 to 4.6. Also: does the difference between the images after T and T/2
// paths, which can be known while rendering, bound the one to the converged image, which cannot (figure 4.8)?

#include <functional>
#include <optional>
#include <vector>

#include "src/walkthrough/walkthrough.h"

namespace promenade::walkthrough {

struct ConvergencePoint {
  double seconds = 0.0;                    ///< of tracing up to here, and what went before
  int paths = 0;                           ///< of every sample that needs any
  double percentVisible = 0.0;             ///< of the pixels: P > 0.75 against the converged image
  std::optional<double> predictedPercent;  ///< stopping.h; nothing for the first image
  /// Mean pooled JND, and what is predicted of it: they tell images apart that differ visibly everywhere.
  double jnd = 0.0;
  std::optional<double> predictedJnd;
};

/// Called with the frame after 1, 2, 4, ... paths and the seconds that tracing took so far.
using AfterPaths = std::function<void(const Frame&, int paths, double seconds)>;

/// Renders `camera` (at display resolution) with up to `mostPaths` paths a sample, a power of two.
void renderProgressively(const Renderer& renderer, const Camera& camera, const Settings& settings,
                         int mostPaths, const AfterPaths& after);

/// The picture that others converge to, on the display in frame settings.frames.first.
struct Converged {
  LuminanceMap seen;
  Surroundings surroundings;  ///< its own, which those that are compared with it share
};
[[nodiscard]] Converged convergedTo(const Frame& frame, const Settings& settings);

/// The curve of one solution against `converged`, as seen on the display in frame settings.frames.first.
/// `secondsBefore`: what it took before the first path (a light solution).
[[nodiscard]] std::vector<ConvergencePoint> convergenceOf(const Renderer& renderer, const Camera& camera,
                                                          const Settings& settings,
                                                          const Converged& converged, int mostPaths,
                                                          double secondsBefore);

}  // namespace promenade::walkthrough
