#pragma once
// The reference renderer: unbiased path tracing on Embree. Light transport: Kajiya, The Rendering Equation
// (1986); multiple importance sampling: Veach, Robust Monte Carlo Methods for Light Transport Simulation
// (1997), ch. 9.
//
// Every sample has exactly one primary hit, at the sample's centre; `pathsPerSample` paths start from that
// hit, or, where it is smooth glass, a mirror or blended, share the ends of the lines of sight through it
// (docs/method.md; up to about twice as many). With a light solution a reflection gets as many as those of
// the samples asked for around it need (so which are asked for changes how noisy it is, and hardly its mean).
// What a single-sided material (glTF doubleSided == false) looks like from behind: a solid surface like its
// front, but it does not shine there. (The common convention of path tracers; culling would open closed rooms
// to the sky.)

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "src/core/camera.h"
#include "src/core/progress.h"
#include "src/core/renderer.h"
#include "src/scene/scene.h"

namespace promenade::render {

/// What smooth transparent solids (KHR_materials_volume with a thickness) do to light.
enum class SolidGlass {
  kRefracts,  ///< always: unbiased, but light on a diffuse surface that came through such a solid is noise
  /// Paths that have been scattered by something other than a mirror, and shadow rays, pass straight through
  /// like through a thin pane, losing what half the material's thickness absorbs at each surface. What is
  /// seen through the solid is still refracted; bright caustics become soft shadows.
  kStraightAfterScattering,
};

/// A view-independent solution of the light on matt surfaces, for one scene (irradiance_solution.h,
/// docs/method.md).
struct LightSolution;

struct PathSettings {
  int pathsPerSample = 16;  ///< >= 1; a power of two stratifies best
  /// Scatterings along a path, >= 0; 0: emission only, 1: direct light. Light that bounces more often is
  /// missing; most paths end much sooner, by Russian roulette. (With 8, the Cornell box lacks 7.5 per cent.)
  int maxBounces = 64;
  std::uint64_t seed = 0;
  int threads = 0;  ///< 0 = all
  /// Width of what a sample stands for, over which textures and bumps are averaged, in distances between
  /// samples, > 0. Below 1 for frames whose samples are put together with those of other frames.
  float sampleWidth = 1.0f;
  /// Most that one path may add to a sample after its first scattering, per channel. Finite values trade
  /// energy for the absence of bright dots (biased).
  float indirectLimit = std::numeric_limits<float>::infinity();
  /// Least perceptual roughness, in [0, 1], of what a path meets after a scattering that was not a mirror's,
  /// panes excepted. Above 0 light that reaches a diffuse surface by way of a mirror is blurred instead of
  /// arriving as bright dots (biased; Kaplanyan, Dachsbacher, Path Space Regularization, 2013).
  float leastIndirectRoughness = 0.0f;
  SolidGlass solidGlass = SolidGlass::kRefracts;
  /// Where this reaches, light on matt surfaces is interpolated from it: the same from frame to frame and
  /// free of noise. What point, spot and directional lights send directly, and reflections and transmission,
  /// are still traced, with pathsPerSample paths where they matter. Biased: penumbrae and contact shadows
  /// finer than a few pixels are blurred. Null: paths alone.
  std::shared_ptr<const LightSolution> solution = {};
  /// Called now and then from any thread during long work; may throw Interrupted, which ends the call
  /// cleanly.
  std::function<void()> checkpoint = {};
};

/// `scene` must outlive the renderer and must not change. Throws CannotContinue if memory runs out.
[[nodiscard]] std::unique_ptr<Renderer> makePathRenderer(const Scene& scene, const PathSettings& settings);

/// Computes what the walk of `cameras` (at display resolution) looks at. Uses settings.seed, threads,
/// maxBounces and checkpoint; the result does not depend on the number of threads. `known`, of the same
/// scene, is extended where cameras that it was not made for look; it is returned as it is if there are none.
/// May be null. `progress` may be empty.
[[nodiscard]] std::shared_ptr<const LightSolution> solveLight(
    const Scene& scene, const PathSettings& settings, std::span<const Camera> cameras,
    const std::shared_ptr<const LightSolution>& known, const ProgressCallback& progress);

/// May so many paths be traced besides those that were announced? Asked where light turns out to be noisy (a
/// room that is lit by way of a small bright patch); if not, it stays so.
using MayTrace = std::function<bool(std::uint64_t paths)>;

/// Makes a light solution level by level, from coarse to fine, for whoever cannot wait for all of it.
class LightSolver {
 public:
  LightSolver() = default;
  LightSolver(const LightSolver&) = delete;
  LightSolver& operator=(const LightSolver&) = delete;
  virtual ~LightSolver() = default;

  /// Every level halves the distance of records on what the cameras see. 0: the solution is that of
  /// solveLight(), unless paths were refused.
  [[nodiscard]] virtual int levelsLeft() const = 0;
  /// Places the records of the next level, unless that is done. Returns how many paths gathering their light
  /// will take at least.
  virtual std::uint64_t place() = 0;
  /// Finishes the next level. `progress` and `mayTrace` may be empty: nothing is refused then. If one of them
  /// or the checkpoint throws, what was known stays, and a later call makes the whole level.
  virtual void gather(const ProgressCallback& progress, const MayTrace& mayTrace) = 0;
  /// A copy of what is known, to render with. Until it is done it is not one for these cameras that
  /// solveLight() would take for whole.
  [[nodiscard]] virtual std::shared_ptr<const LightSolution> solution() const = 0;
};

/// As solveLight(). `scene` must outlive the solver.
[[nodiscard]] std::unique_ptr<LightSolver> makeLightSolver(const Scene& scene, const PathSettings& settings,
                                                           std::span<const Camera> cameras,
                                                           const std::shared_ptr<const LightSolution>& known);

/// What a solution holds.
struct LightSolutionSize {
  std::size_t records = 0;
  std::size_t cameras = 0;
  /// Traced to gather light by the call that made or extended it; 0 if it was read from a file.
  std::uint64_t rays = 0;
};
[[nodiscard]] LightSolutionSize sizeOf(const LightSolution& solution);
/// Whether solveLight() would take it as it is for that camera.
[[nodiscard]] bool isWholeFor(const Camera& camera, const LightSolution& solution);

/// A solution as the contents of a file (docs/formats.md); `key` names what it is the light of.
[[nodiscard]] std::string toBytes(const LightSolution& solution, std::string_view key);
/// The reverse; null if the bytes are no solution, of another version, damaged, or of another key.
[[nodiscard]] std::shared_ptr<const LightSolution> lightSolutionFrom(std::string_view bytes,
                                                                     std::string_view key);

}  // namespace promenade::render
