// The metric's cost at 40 pixels per degree, in wall time and peak memory, beside the time of the Fourier
// transforms that it plans: as two-dimensional transforms of FFTW (complex to real, single precision,
// estimated plans), shared among as many threads.

#include <benchmark/benchmark.h>
#include <fftw3.h>
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <chrono>
#include <memory>

#include "aqm/transform_plan.h"
#include "tests/aqm/patterns.h"

namespace promenade::aqm {
namespace {

constexpr double kPpd = 40.0;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

LuminanceMap textured(Size size, double phase) {
  return tests::frameOf(size, [=](int x, int y) {
    return 40.0 + 20.0 * std::sin(x / 7.0 + phase) * std::cos(y / 5.0) + 10.0 * std::sin(x * y / 900.0);
  });
}

/// As when walking forward: 0 at the centre, 20 degrees per second in the corners.
VelocityMap expanding(Size size) {
  return tests::velocityOf(size, [=](int x, int y) {
    return glm::dvec2(x - size.width / 2, y - size.height / 2) / (0.5 * size.width) * 17.4;
  });
}

/// Neighbouring pixels move unlike each other, so that every row needs every speed up to 40 degrees per
/// second.
VelocityMap unrelated(Size size) {
  return tests::velocityOf(size, [](int x, int y) {
    const double angle = 0.7 * x + 1.3 * y;
    const double speed = 40.0 * std::abs(std::sin(0.37 * x * y + x));
    return glm::dvec2(std::cos(angle), std::sin(angle)) * speed;
  });
}

VelocityMap still(Size) {
  return {};
}

/// Every thread has buffers of its own, as the metric has.
class Transforms {
 public:
  explicit Transforms(Size size)
      : size_(size),
        half_(static_cast<std::size_t>(size.width / 2 + 1) * static_cast<std::size_t>(size.height)) {
    const Buffers buffers = make();
    plan_ = fftwf_plan_dft_c2r_2d(size.height, size.width, buffers.complex.get(), buffers.real.get(),
                                  FFTW_ESTIMATE | FFTW_DESTROY_INPUT);
  }
  ~Transforms() { fftwf_destroy_plan(plan_); }
  Transforms(const Transforms&) = delete;
  Transforms& operator=(const Transforms&) = delete;

  [[nodiscard]] double secondsOf(int count) const {
    const int threads =
        static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
    std::vector<Buffers> buffers(static_cast<std::size_t>(threads));
    for (Buffers& one : buffers) {
      one = make();
    }
    const double start = seconds();
    tbb::parallel_for(0, threads, [&](int thread) {
      const Buffers& mine = buffers[static_cast<std::size_t>(thread)];
      for (int i = thread; i < count; i += threads) {
        fftwf_execute_dft_c2r(plan_, mine.complex.get(), mine.real.get());
      }
    });
    return seconds() - start;
  }

 private:
  struct Free {
    void operator()(void* memory) const { fftwf_free(memory); }
  };
  struct Buffers {
    std::unique_ptr<fftwf_complex[], Free> complex;
    std::unique_ptr<float[], Free> real;
  };
  [[nodiscard]] Buffers make() const {
    Buffers buffers{std::unique_ptr<fftwf_complex[], Free>(fftwf_alloc_complex(half_)),
                    std::unique_ptr<float[], Free>(fftwf_alloc_real(size_.area()))};
    std::fill_n(&buffers.complex[0][0], 2 * half_, 0.0f);
    return buffers;
  }

  Size size_;
  std::size_t half_;
  fftwf_plan plan_;
};

std::string textOf(const std::vector<PlannedTransforms>& plan) {
  std::string text;
  for (const PlannedTransforms& part : plan) {
    text += (text.empty() ? "" : ", ") + std::to_string(part.forward + part.inverse) + " of " +
            std::to_string(part.size.width) + "x" + std::to_string(part.size.height);
  }
  return text;
}

void compareFrames(benchmark::State& state, Size size, VelocityMap (*velocityOf)(Size), Execution execution) {
  const LuminanceMap test = textured(size, 0.0);
  const LuminanceMap reference = textured(size, 0.05);
  const VelocityMap velocity = velocityOf(size);
  Settings settings = aqm(kPpd);
  settings.execution = execution;
  double metric = 1e30;
  for (auto _ : state) {
    const double start = seconds();
    benchmark::DoNotOptimize(compare(test, reference, velocity, settings));
    metric = std::min(metric, seconds() - start);
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_MB"] = static_cast<double>(usage.ru_maxrss) / 1024.0;
  const std::vector<PlannedTransforms> plan = plannedTransforms(size, velocity, settings);
  double transforms = 0.0;
  for (const PlannedTransforms& part : plan) {
    const Transforms work(part.size);
    const int count = part.forward + part.inverse;
    transforms += std::min(work.secondsOf(count), work.secondsOf(count));
  }
  state.counters["transforms_ms"] = 1e3 * transforms;
  state.counters["ratio"] = metric / transforms;
  state.SetLabel(textOf(plan));
}

constexpr Size kHd{1280, 720};
constexpr Size kFullHd{1920, 1080};
constexpr Size kUltraHd{3840, 2160};

#define METRIC_BENCHMARK(name, ...) \
  BENCHMARK_CAPTURE(compareFrames, name, __VA_ARGS__)->Unit(benchmark::kMillisecond)->UseRealTime()

METRIC_BENCHMARK(hd_still, kHd, still, Execution::kFast);
METRIC_BENCHMARK(hd_walking, kHd, expanding, Execution::kFast);
METRIC_BENCHMARK(hd_unrelated, kHd, unrelated, Execution::kFast);
METRIC_BENCHMARK(hd_still_plain, kHd, still, Execution::kPlain);
METRIC_BENCHMARK(hd_walking_plain, kHd, expanding, Execution::kPlain);
METRIC_BENCHMARK(fullhd_still, kFullHd, still, Execution::kFast);
METRIC_BENCHMARK(fullhd_walking, kFullHd, expanding, Execution::kFast);
METRIC_BENCHMARK(ultrahd_walking, kUltraHd, expanding, Execution::kFast);

void equalFrames(benchmark::State& state) {
  const LuminanceMap frame = textured(kHd, 0.0);
  const LuminanceMap same = frame.clone();
  const VelocityMap velocity = expanding(kHd);
  for (auto _ : state) {
    benchmark::DoNotOptimize(compare(frame, same, velocity, aqm(kPpd)));
  }
}
BENCHMARK(equalFrames)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace promenade::aqm

BENCHMARK_MAIN();
