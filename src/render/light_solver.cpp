#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

#include "src/render/irradiance_solution.h"
#include "src/render/path_renderer.h"
#include "src/render/path_settings.h"
#include "src/render/path_tracer.h"

namespace promenade::render {
namespace {

class SteppedLightSolver final : public LightSolver {
 public:
  SteppedLightSolver(const Scene& scene, const PathSettings& settings, std::span<const Camera> cameras,
                     const std::shared_ptr<const LightSolution>& known)
      : solution_(solutionSettings(settings)),
        tracer_(scene, gathering(settings)),
        arena_(settings.threads > 0 ? settings.threads : tbb::task_arena::automatic),
        solver_(tracer_, cameras, solution_, known) {}

  [[nodiscard]] int levelsLeft() const override { return solver_.levelsLeft(); }
  std::uint64_t place() override {
    return arena_.execute([&] { return solver_.place(); });
  }
  void gather(const ProgressCallback& progress, const MayTrace& mayTrace) override {
    arena_.execute([&] { solver_.gather(progress, mayTrace); });
  }
  [[nodiscard]] std::shared_ptr<const LightSolution> solution() const override {
    return std::make_shared<const LightSolution>(solver_.solution());
  }
  [[nodiscard]] std::shared_ptr<const LightSolution> take() && {
    return std::make_shared<const LightSolution>(std::move(solver_).take());
  }

 private:
  static PathSettings gathering(PathSettings settings) {
    settings.solution = nullptr;
    // What solid glass casts on matt surfaces would be found by chance only, and show as blotches.
    settings.solidGlass = SolidGlass::kStraightAfterScattering;
    return settings;
  }
  static SolutionSettings solutionSettings(const PathSettings& settings) {
    SolutionSettings solution;
    solution.seed = seedOf(settings);
    solution.checkpoint = settings.checkpoint;
    return solution;
  }

  SolutionSettings solution_;
  PathTracer tracer_;
  tbb::task_arena arena_;
  IrradianceSolver solver_;
};

}  // namespace

std::unique_ptr<LightSolver> makeLightSolver(const Scene& scene, const PathSettings& settings,
                                             std::span<const Camera> cameras,
                                             const std::shared_ptr<const LightSolution>& known) {
  requireGood(settings);
  return std::make_unique<SteppedLightSolver>(scene, settings, cameras, known);
}

std::shared_ptr<const LightSolution> solveLight(const Scene& scene, const PathSettings& settings,
                                                std::span<const Camera> cameras,
                                                const std::shared_ptr<const LightSolution>& known,
                                                const ProgressCallback& progress) {
  requireGood(settings);
  if (known && std::all_of(cameras.begin(), cameras.end(),
                           [&](const Camera& camera) { return known->isFor(camera); })) {
    return known;  // before the scene is built for tracing
  }
  SteppedLightSolver solver(scene, settings, cameras, known);
  while (solver.levelsLeft() > 0) solver.gather(progress, {});
  return std::move(solver).take();
}

}  // namespace promenade::render
