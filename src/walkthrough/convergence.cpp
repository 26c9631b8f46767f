#include "src/walkthrough/convergence.h"

#include <numbers>
#include <numeric>
#include <utility>

#include "src/walkthrough/seen.h"
#include "src/walkthrough/stopping.h"

namespace promenade::walkthrough {
namespace {

double mean(const JndMap& map) {
  const auto pixels = map.pixels();
  if (pixels.empty()) return 0.0;
  return std::accumulate(pixels.begin(), pixels.end(), 0.0) / static_cast<double>(pixels.size());
}

}  // namespace

void renderProgressively(const Renderer& renderer, const Camera& camera, const Settings& settings,
                         int mostPaths, const AfterPaths& after) {
  double seconds = 0.0;
  Frame frame;
  Mask open;
  for (int paths = 0; paths < mostPaths; paths = paths == 0 ? 1 : 2 * paths) {
    {
      const Stopwatch watch(seconds);
      if (paths == 0) {
        frame = unshaded(renderer.visibility(camera.supersampled(settings.supersample)));
        open = renderer.refine(frame, Mask(frame.diffuse.size(), 1), {.before = 0, .count = 1}, 0).open;
      } else {
        open = renderer.refine(frame, open, {.before = paths, .count = paths}, 0).open;
      }
    }
    after(frame, paths == 0 ? 1 : 2 * paths, seconds);
  }
}

Converged convergedTo(const Frame& frame, const Settings& settings) {
  Surroundings surroundings = surroundingsOf(frame, settings.frames.first, settings);
  LuminanceMap seen = seenOnDisplay(frame, settings.frames.first, settings, surroundings);
  return {std::move(seen), std::move(surroundings)};
}

std::vector<ConvergencePoint> convergenceOf(const Renderer& renderer, const Camera& camera,
                                            const Settings& settings, const Converged& converged,
                                            int mostPaths, double secondsBefore) {
  const auto difference = [&](const LuminanceMap& a, const LuminanceMap& b) {
    return aqm::compare(a, b, VelocityMap(), aqm::Settings{settings.display.pixelsPerDegree()});
  };
  std::vector<ConvergencePoint> points;
  LuminanceMap afterHalf;
  renderProgressively(
      renderer, camera, settings, mostPaths, [&](const Frame& frame, int paths, double seconds) {
        LuminanceMap now = seenOnDisplay(frame, settings.frames.first, settings, converged.surroundings);
        const aqm::Result truth = difference(now, converged.seen);
        ConvergencePoint point;
        point.seconds = secondsBefore + seconds;
        point.paths = paths;
        point.percentVisible = aqm::percentVisible(truth.probability, Mask());
        point.jnd = mean(truth.pooledJnd);
        if (!afterHalf.empty()) {
          const JndMap predicted = difference(now, afterHalf).pooledJnd;
          point.predictedPercent = predictedPercent(predicted);
          point.predictedJnd = std::numbers::sqrt2 * mean(predicted);
        }
        points.push_back(point);
        afterHalf = std::move(now);
      });
  return points;
}

}  // namespace promenade::walkthrough
