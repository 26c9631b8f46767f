// The metric's cost on a pair of 1280 x 720 frames at 40 pixels per degree, in wall time and peak memory.

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include "tests/aqm/patterns.h"

namespace promenade::aqm {
namespace {

constexpr Size kSize{1280, 720};

LuminanceMap textured(double phase) {
  return tests::frameOf(kSize, [=](int x, int y) {
    return 40.0 + 20.0 * std::sin(x / 7.0 + phase) * std::cos(y / 5.0) + 10.0 * std::sin(x * y / 900.0);
  });
}

void compareFrames(benchmark::State& state, const VelocityMap& velocity) {
  const LuminanceMap test = textured(0.0);
  const LuminanceMap reference = textured(0.05);
  for (auto _ : state) {
    benchmark::DoNotOptimize(compare(test, reference, velocity, Settings{40.0}));
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_MB"] = static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void BM_StaticScene(benchmark::State& state) {
  compareFrames(state, {});
}
BENCHMARK(BM_StaticScene)->Unit(benchmark::kMillisecond)->UseRealTime();

/// As when walking forward: 0 at the centre, 20 degrees per second in the corners.
void BM_ExpandingFlow(benchmark::State& state) {
  compareFrames(state, tests::velocityOf(kSize, [](int x, int y) {
                  return glm::dvec2((x - 640.0) / 640.0, (y - 360.0) / 640.0) * 17.4;
                }));
}
BENCHMARK(BM_ExpandingFlow)->Unit(benchmark::kMillisecond)->UseRealTime();

/// The dearest case: neighbouring pixels move unlike each other, so that every row needs every speed level up
/// to 40 degrees per second.
void BM_UnrelatedVelocities(benchmark::State& state) {
  compareFrames(state, tests::velocityOf(kSize, [](int x, int y) {
                  const double angle = 0.7 * x + 1.3 * y;
                  const double speed = 40.0 * std::abs(std::sin(0.37 * x * y + x));
                  return glm::dvec2(std::cos(angle), std::sin(angle)) * speed;
                }));
}
BENCHMARK(BM_UnrelatedVelocities)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace promenade::aqm

BENCHMARK_MAIN();
