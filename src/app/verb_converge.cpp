#include <bit>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "src/app/folders.h"
#include "src/app/formatted.h"
#include "src/app/interrupt.h"
#include "src/app/render_job.h"
#include "src/app/threads.h"
#include "src/app/values.h"
#include "src/app/verbs.h"
#include "src/core/errors.h"
#include "src/io/plot.h"
#include "src/io/text_file.h"
#include "src/render/path_renderer.h"
#include "src/walkthrough/convergence.h"
#include "src/walkthrough/seen.h"

namespace promenade::app {
namespace {

using walkthrough::ConvergencePoint;
using walkthrough::Stopwatch;

struct Curve {
  std::string solution;
  std::vector<ConvergencePoint> points;
};

int powerOfTwoFrom(const std::string& text, const std::string& option) {
  const int value = integerFrom(text, 1, 1 << 20, option);
  if (!std::has_single_bit(static_cast<unsigned>(value))) {
    throw InputError(option + ": expected a power of two, found " + std::to_string(value));
  }
  return value;
}

std::string cell(const std::optional<double>& value) {
  if (!value) return "";
  return formatted("%.4f", *value);
}

std::string csv(const std::vector<Curve>& curves) {
  std::string text = "solution,seconds,paths,percent_visible,predicted_percent,jnd,predicted_jnd\n";
  for (const Curve& curve : curves) {
    for (const ConvergencePoint& p : curve.points) {
      text += formatted("%s,%.3f,%d,%.4f,", curve.solution.c_str(), p.seconds, p.paths, p.percentVisible);
      text += cell(p.predictedPercent) + "," + cell(p.jnd) + "," + cell(p.predictedJnd);
      text += "\n";
    }
  }
  return text;
}

/// What is drawn of a point, and what is predicted of it.
struct Drawn {
  std::string unit;
  double ConvergencePoint::*truth;
  std::optional<double> ConvergencePoint::*predicted;
};

std::string svg(const std::vector<Curve>& curves, const Drawn& drawn) {
  std::vector<io::Series> series;
  for (const Curve& curve : curves) {
    io::Series truth{curve.solution, {}, {}, io::Mark::kLine};
    io::Series prediction{curve.solution + ", predicted", {}, {}, io::Mark::kPoints};
    for (const ConvergencePoint& p : curve.points) {
      truth.x.push_back(p.seconds);
      truth.y.push_back(p.*drawn.truth);
      const std::optional<double>& predicted = p.*drawn.predicted;
      if (!predicted) continue;
      prediction.x.push_back(p.seconds);
      prediction.y.push_back(*predicted);
    }
    series.push_back(std::move(truth));
    series.push_back(std::move(prediction));
  }
  return io::plotted("Perceptual convergence", {"seconds", io::Scale::kLogarithmic},
                     {drawn.unit, io::Scale::kLinear}, series);
}

std::string summary(const Curve& curve) {
  const ConvergencePoint& last = curve.points.back();
  return formatted("%-12s %5d paths %8.1f s %7.2f%% visible\n", curve.solution.c_str(), last.paths,
                   last.seconds, last.percentVisible);
}

}  // namespace

ExitStatus runConverge(const ConvergeOptions& options, Console& console) {
  const RenderValues values = renderValues(options.job);
  const int mostPaths = powerOfTwoFrom(options.mostPaths, "--most-spp");
  const int convergedPaths = powerOfTwoFrom(options.convergedPaths, "--converged-spp");
  const ThreadLimit threads(values.threads);
  const Scene scene = sceneFor(options.job);
  for (const std::string& warning : scene.warnings) console.warning(scene.source + ": " + warning);
  const paths::CameraPath path = walkFor(options.job, values, scene);
  const int frame = integerFrom(options.frame, 0, path.frameCount() - 1, "--frame");
  const Camera camera = path.camera(frame, values.size);
  makeFolder(options.job.out);
  walkthrough::Settings settings = settingsFor(options.job, values, path);
  settings.frames = {frame, frame};

  const render::PathSettings paths{
      .seed = values.seed, .threads = threads.count(), .checkpoint = [] { throwIfInterrupted(); }};
  walkthrough::Converged converged;
  {
    // Another seed, so that no solution shares its noise.
    render::PathSettings other = paths;
    other.seed = values.seed + 1;
    const auto renderer = render::makePathRenderer(scene, other);
    settings.tone = toneFor(values, scene, path, *renderer, settings);
    walkthrough::renderProgressively(
        *renderer, camera, settings, convergedPaths, [&](const Frame& image, int count, double) {
          console.progress()({"converged image: paths", static_cast<std::uint64_t>(count),
                              static_cast<std::uint64_t>(convergedPaths)});
          if (count == convergedPaths) converged = convergedTo(image, settings);
        });
    console.endProgress();
  }

  std::vector<Curve> curves;
  curves.push_back({"path", walkthrough::convergenceOf(*render::makePathRenderer(scene, paths), camera,
                                                       settings, converged, mostPaths, 0.0)});
  console.result(summary(curves.back()));
  render::PathSettings solved = paths;
  double solving = 0.0;
  {
    const Stopwatch watch(solving);
    solved.solution = render::solveLight(scene, paths, std::span(&camera, 1), nullptr, console.progress());
  }
  console.endProgress();
  curves.push_back(
      {"walkthrough", walkthrough::convergenceOf(*render::makePathRenderer(scene, solved), camera, settings,
                                                 converged, mostPaths, solving)});
  console.result(summary(curves.back()));
  const std::filesystem::path folder(options.job.out);
  io::writeTextFile(folder / "convergence.csv", csv(curves));
  io::writeTextFile(folder / "convergence.svg",
                    svg(curves, {"% of the pixels with P > 0.75", &ConvergencePoint::percentVisible,
                                 &ConvergencePoint::predictedPercent}));
  io::writeTextFile(folder / "difference.svg", svg(curves, {"mean difference, JND", &ConvergencePoint::jnd,
                                                            &ConvergencePoint::predictedJnd}));
  return ExitStatus::kDone;
}

}  // namespace promenade::app
