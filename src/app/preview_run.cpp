#include "src/app/preview_run.h"

#include <filesystem>
#include <memory>
#include <utility>

#include "src/app/elapsed.h"
#include "src/app/folders.h"
#include "src/app/formatted.h"
#include "src/app/frame_output.h"
#include "src/app/interrupt.h"
#include "src/app/render_job.h"
#include "src/app/solved_light.h"
#include "src/app/threads.h"
#include "src/core/errors.h"
#include "src/io/atomic_file.h"
#include "src/io/exr_frame.h"
#include "src/io/png.h"
#include "src/render/path_renderer.h"
#include "src/walkthrough/finishing.h"
#include "src/walkthrough/preview.h"
#include "src/walkthrough/statistics.h"

namespace promenade::app {
namespace {

namespace fs = std::filesystem;
using walkthrough::Preview;
using walkthrough::PreviewStage;

void refuseWhatIsOfAWalk(const RenderOptions& options) {
  const RenderOptions plain;
  for (const auto& [name, isGiven] :
       {std::pair("--from", !options.from.empty()), std::pair("--renderer", !options.renderer.empty()),
        std::pair("--method", options.method != plain.method), std::pair("--spp", options.spp != plain.spp),
        std::pair("--tolerance", options.tolerance != plain.tolerance),
        std::pair("--spacing", options.spacing != plain.spacing),
        std::pair("--verify", options.verify != plain.verify),
        std::pair("--footprint-limit", options.footprintLimit != plain.footprintLimit),
        std::pair("--filter", options.filter != plain.filter),
        std::pair("--filter-radius", options.filterRadius != plain.filterRadius),
        std::pair("--video", !options.video.empty()), std::pair("--maps", options.maps),
        std::pair("--resume", options.resume), std::pair("--overwrite", options.overwrite)}) {
    if (isGiven) {
      throw InputError(std::string(name) +
                       ": not with --preview, which makes one picture in the time it is given");
    }
  }
}

/// The light solution of one view, made level by level.
class SolverLight final : public walkthrough::SteppedLight {
 public:
  /// Its random numbers are not those of `settings`. `scene` must outlive this.
  SolverLight(const Scene& scene, const render::PathSettings& settings, const Camera& camera,
              const std::shared_ptr<const render::LightSolution>& known)
      : scene_(scene), settings_(settings) {
    ++settings_.seed;
    render::PathSettings stepped = settings_;
    stepped.checkpoint = [this, usual = settings_.checkpoint] {
      usual();
      if (checkpoint_) checkpoint_();
    };
    solver_ = render::makeLightSolver(scene_, stepped, std::span(&camera, 1), known);
  }

  [[nodiscard]] int levelsLeft() const override { return solver_->levelsLeft(); }
  std::uint64_t place(const Checkpoint& checkpoint) override {
    checkpoint_ = checkpoint;
    return solver_->place();
  }
  void gather(const Checkpoint& checkpoint, const MayTrace& mayTrace) override {
    checkpoint_ = checkpoint;
    solver_->gather({}, mayTrace);
  }
  [[nodiscard]] std::unique_ptr<const Renderer> renderer() const override {
    render::PathSettings lit = settings_;
    lit.solution = solver_->solution();
    return render::makePathRenderer(scene_, lit);
  }

 private:
  const Scene& scene_;
  render::PathSettings settings_;
  Checkpoint checkpoint_;
  std::unique_ptr<render::LightSolver> solver_;
};

/// Of an earlier run of the scene; null: there is none.
std::shared_ptr<const render::LightSolution> knownLight(const LoadedJob& job, Console& console) {
  const RenderOptions& options = job.options;
  const fs::path file = options.lightSolution.empty() ? fs::path(options.out) / "light-solution.bin"
                                                      : fs::path(options.lightSolution);
  return keptLight(file, lightHash(options, job.scene), "it is not used", console);
}

std::string summaryOf(const Preview& preview) {
  const bool isTraced = preview.stage == PreviewStage::kStochastic;
  std::string text = formatted("stage %d of 3, ", static_cast<int>(preview.stage));
  text += isTraced ? "path tracing" : "light solution";
  if (!isTraced && preview.levelsLeft > 0) {
    text += formatted(", %d times as coarse as a walk's", 1 << preview.levelsLeft);
  }
  text += formatted("; paths a sample: %d", preview.paths);
  if (preview.error) {
    text += formatted("; error %s %.0f%%", isTraced ? "about" : "at most about", 100.0 * *preview.error);
  }
  if (preview.predictedPercent) {
    text += formatted("; noise predicted to be visible on %.1f%% of the pixels", *preview.predictedPercent);
  }
  return text + "\n";
}

}  // namespace

ExitStatus runPreview(const RenderOptions& options, Console& console) {
  refuseWhatIsOfAWalk(options);
  const double budget = numberFrom(options.preview, 0.01, 1e6, "--preview");
  const ThreadLimit threads(renderValues(options).threads);
  LoadedJob job = loadJob(options);
  makeFolder(options.out);
  const fs::path folder(options.out);
  const fs::path file = folder / "preview.exr";
  io::removeLeftoverTemporaries(folder);
  {
    // Whether the folder can be written shows before the work.
    const io::AtomicFile probe(file);
  }
  console.keepLog(folder / "promenade.log", options.command);
  for (const std::string& warning : job.scene.warnings) console.warning(job.scene.source + ": " + warning);
  render::PathSettings paths{
      .seed = job.values.seed, .threads = threads.count(), .checkpoint = [] { throwIfInterrupted(); }};
  const int frame = job.settings.frames.first;
  const Camera camera = job.path.camera(frame, job.settings.size);
  std::unique_ptr<Renderer> renderer;
  std::shared_ptr<const render::LightSolution> known;
  bool isWhole = false;
  {
    const walkthrough::Stopwatch watch(job.secondsLoading);
    if (options.integrator == "walkthrough") known = knownLight(job, console);
    isWhole = known && render::isWholeFor(camera, *known);
    if (isWhole) paths.solution = known;
    renderer = render::makePathRenderer(job.scene, paths);
  }

  const auto start = Clock::now();
  const walkthrough::Clock clock = [start] { return secondsSince(start); };
  walkthrough::Settings settings = job.settings;
  settings.tone = toneFor(job.values, job.scene, job.path, *renderer, settings);
  settings.frames = {frame, frame};
  walkthrough::MakeSteppedLight makeLight;
  if (options.integrator == "walkthrough") {
    makeLight = [&] { return std::make_unique<SolverLight>(job.scene, paths, camera, known); };
  }
  walkthrough::PreviewRule rule;
  rule.budgetSeconds = budget;
  rule.progress = console.progress();
  Preview preview = isWhole ? walkthrough::previewByKnownLight(*renderer, camera, settings, rule, clock)
                            : walkthrough::preview(*renderer, makeLight, camera, settings, rule, clock);
  console.endProgress();

  const fs::path picture = folder / "preview.png";
  const std::string summary = summaryOf(preview);
  walkthrough::Finishing finishing(job.path, settings, [&](walkthrough::FinishedFrame&& finished) {
    io::write8bit(picture, encodeForDisplay(finished.radiance, settings.tone.at(frame, settings.display)));
    io::writeFrame(file, fileOf(std::move(finished), job.path, options.scene, job.hash));
  });
  finishing.begin(settings.frames);
  finishing.add(frame, std::make_shared<const Frame>(std::move(preview.frame)),
                walkthrough::FrameKind::kKeyframe);
  const std::string times = formatted(": frame %d after %.1f s of %g (scene read in %.1f s)\n", frame,
                                      secondsSince(start), budget, job.secondsLoading);
  console.result(file.string() + ", " + picture.string() + times + summary);
  return ExitStatus::kDone;
}

}  // namespace promenade::app
