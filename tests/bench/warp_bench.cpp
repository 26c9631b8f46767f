// Samples a second (items_per_second) of warping, blending, pixel flow and filtering, on all threads.

#include <benchmark/benchmark.h>

#include <array>
#include <limits>

#include "ibr/blend.h"
#include "ibr/flow.h"
#include "ibr/temporal_filter.h"
#include "tests/ibr/analytic_scene.h"

namespace promenade::ibr::tests {
namespace {

/// A walk's worth of parallax in a room with a few objects: one keyframe and a view some frames later.
struct View {
  Frame source;
  Frame target;
};

const View& view() {
  static const View made = [] {
    AnalyticScene scene;
    scene.setBackground(waves(0.5))
        .add(1, rectangle({-3, -1, -4}, {6, 0, 0}, {0, 3, 0}), waves(0.8))
        .add(2, rectangle({-3, -1, -4}, {6, 0, 0}, {0, 0, 8}), stripes(0.2))
        .add(3, sphere({-0.7, -0.4, -3}, 0.6), waves(0.6))
        .add(4, box({0.4, -1, -3.2}, {1.2, -0.2, -2.6}), waves(0.5));
    const Size size{1280, 720};
    return View{scene.render(cameraAt({0, 0.3, 0}, size, 700.0)),
                scene.render(turnedCamera({0.08, 0.31, -0.1}, 0.03, 0.01, 0.0, size, 700.0))};
  }();
  return made;
}

void countSamples(benchmark::State& state) {
  state.SetItemsProcessed(state.iterations() *
                          static_cast<std::int64_t>(view().source.diffuse.size().area()));
}

void gather(benchmark::State& state) {
  const View& v = view();
  for (auto _ : state) {
    benchmark::DoNotOptimize(gatherWarp(v.source, v.target.visibility, {}));
  }
  countSamples(state);
}
BENCHMARK(gather)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void forward(benchmark::State& state) {
  const View& v = view();
  for (auto _ : state) {
    benchmark::DoNotOptimize(forwardWarp(v.source, v.target.visibility.camera, {}));
  }
  countSamples(state);
}
BENCHMARK(forward)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void blendOfTwo(benchmark::State& state) {
  const View& v = view();
  const Warped a = gatherWarp(v.source, v.target.visibility, {});
  const Warped b = gatherWarp(v.target, v.target.visibility, {});
  const Visibility& seen = v.target.visibility;
  for (auto _ : state) {
    benchmark::DoNotOptimize(blend(
        a, b, Visibility{seen.camera, seen.depth.clone(), seen.normal.clone(), seen.item.clone()}, 0.4));
  }
  countSamples(state);
}
BENCHMARK(blendOfTwo)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void flow(benchmark::State& state) {
  const View& v = view();
  for (auto _ : state) {
    benchmark::DoNotOptimize(pixelFlow(v.source.visibility, v.target.visibility.camera));
  }
  countSamples(state);
}
BENCHMARK(flow)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void velocity(benchmark::State& state) {
  const View& v = view();
  const PixelFlow back = pixelFlow(v.target.visibility, v.source.visibility.camera);
  const PixelFlow forth = pixelFlow(v.source.visibility, v.target.visibility.camera);
  for (auto _ : state) {
    benchmark::DoNotOptimize(imageVelocity(back, forth, 25.0, 40.0));
  }
  countSamples(state);
}
BENCHMARK(velocity)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

/// 640x360 display pixels of four samples, from two frames: items are samples of the other one.
void temporal(benchmark::State& state) {
  const View& v = view();
  const WindowMap window({640, 360}, std::numeric_limits<float>::infinity());
  const std::array<NearbyFrame, 1> others{{{&v.source, 1}}};
  for (auto _ : state) {
    benchmark::DoNotOptimize(temporalFilter(v.target, 2, others, window, {}));
  }
  countSamples(state);
}
BENCHMARK(temporal)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

}  // namespace
}  // namespace promenade::ibr::tests
