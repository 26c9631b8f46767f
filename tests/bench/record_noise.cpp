// How noisy are the records of a light solution? Some of its fine records are gathered again with several
// seeds, from its own coarse ones.
//
//     promenade render SCENE --sky --out walk ...
//     record_noise SCENE walk/light-solution.bin sky|none bright|plain [PLACES [SEEDS]]
//
// `sky` stands for --sky with its default sun, `bright` for bright surfaces as lights, which the program
// takes where coarse records are noisy. Printed: standard deviation over the seeds, relative to the light
// (mean, median and 90% quantile over the places); the stated standard error over the true deviation; the
// deviation of the light in a lobe (cosine^40 about eight directions) over that of all; processor time.

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <memory>
#include <numbers>
#include <string_view>
#include <vector>

#include "src/core/display.h"
#include "src/core/errors.h"
#include "src/io/text_file.h"
#include "src/render/irradiance_solution.h"
#include "src/render/path_tracer.h"
#include "src/scene/load.h"
#include "src/scene/sky.h"

namespace promenade {
namespace {

using render::Gathered;
using render::LightField;
using render::LightSolution;
using render::RecordPlace;

constexpr std::size_t kMostBytes = std::size_t{4} << 30;

/// Whatever scene it is of: the key stands in the file itself (docs/formats.md).
std::shared_ptr<const LightSolution> solutionFrom(const char* file) {
  const std::string bytes = io::readTextFile(file, kMostBytes);
  constexpr std::size_t kSignature = 16, kBefore = kSignature + sizeof(std::uint64_t);
  std::uint64_t length = 0;
  if (bytes.size() > kBefore) std::memcpy(&length, bytes.data() + kSignature, sizeof(length));
  auto solution = bytes.size() > kBefore + length
                      ? render::lightSolutionFrom(bytes, std::string_view(bytes).substr(kBefore, length))
                      : nullptr;
  if (!solution) throw InputError(file, "expected a light solution of this version");
  return solution;
}

constexpr std::size_t kLobes = 8;
std::array<LightField::Weights, kLobes> lobes() {
  std::array<LightField::Weights, kLobes> result{};
  for (std::size_t l = 0; l < kLobes; ++l) {
    const float height = l < kLobes / 2 ? 0.35f : 0.75f,
                turn = 0.3f + 0.5f * std::numbers::pi_v<float> * static_cast<float>(l);
    const float out = std::sqrt(1.0f - height * height);
    const glm::vec3 axis(out * std::cos(turn), out * std::sin(turn), height);
    for (std::size_t c = 0; c < LightField::kCells; ++c) {
      const float cosine = std::max(0.0f, glm::dot(LightField::directions()[c], axis));
      *result[l].at(c) = LightField::solidAngles()[c] * std::pow(cosine, 40.0f);
    }
  }
  return result;
}

double deviation(const std::vector<double>& values) {
  double mean = 0.0, squares = 0.0;
  for (const double v : values) mean += v / static_cast<double>(values.size());
  for (const double v : values) squares += (v - mean) * (v - mean);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

double seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct Noise {
  double light = 0.0;  ///< mean luminance
  double deviation = 0.0, stated = 0.0, inLobes = 0.0;
};

Noise noiseAt(const render::PathTracer& tracer, const RecordPlace& place, std::size_t number, int seeds) {
  static const auto kLobeWeights = lobes();
  std::vector<double> values;
  std::array<std::vector<double>, kLobes> lobeValues;
  Noise noise;
  for (int seed = 0; seed < seeds; ++seed) {
    render::Sampler::Stream numbers;
    numbers.seed = 1000u + static_cast<std::uint32_t>(seed);
    numbers.pixel = {static_cast<std::uint32_t>(number & 0xffffu), static_cast<std::uint32_t>(number >> 16)};
    render::PathRays rays;
    const Gathered found =
        tracer.gather(place.position, place.normal, numbers, render::SolutionSettings{}.fineEffort, rays);
    values.push_back(luminance(found.light.radiance));
    noise.light += values.back() / seeds;
    noise.stated += static_cast<double>(found.light.error) / seeds;
    for (std::size_t l = 0; l < kLobes; ++l) {
      const Rgb mean = found.field.weighted(kLobeWeights[l]) / kLobeWeights[l].sum();
      lobeValues[l].push_back(values.back() * static_cast<double>(luminance(mean)));
    }
  }
  noise.deviation = deviation(values);
  for (const auto& lobe : lobeValues) noise.inLobes += deviation(lobe) / kLobes;
  return noise;
}

int countFrom(const char* text) {
  int value = 0;
  const std::string_view all(text);
  if (std::from_chars(all.data(), all.data() + all.size(), value).ptr != all.data() + all.size() ||
      value < 2) {
    throw InputError(std::string(text) + ": expected a number from 2 on");
  }
  return value;
}

void run(const std::vector<const char*>& arguments) {
  Scene scene = loadScene(arguments[0]);
  if (std::string_view(arguments[2]) == "sky") {
    constexpr double kDegree = std::numbers::pi / 180.0;
    scene.environment = clearSky(45.0 * kDegree, 30.0 * kDegree, 3.0);
  }
  const auto solution = solutionFrom(arguments[1]);
  const int places = arguments.size() > 4 ? countFrom(arguments[4]) : 200;
  const int seeds = arguments.size() > 5 ? countFrom(arguments[5]) : 8;
  render::PathSettings settings;
  settings.solidGlass = render::SolidGlass::kStraightAfterScattering;
  render::PathTracer tracer(scene, settings);
  tracer.setSolution(std::make_shared<const LightSolution>(LightSolution{solution->coarse, {}, {}, {}}));
  if (std::string_view(arguments[3]) == "bright") tracer.setBright(tracer.findBright());

  std::vector<double> relative, stated, inLobes;
  const double start = seconds();
  for (int i = 0; i < places; ++i) {
    const auto& all = solution->fine.places();
    const std::size_t number =
        (2 * static_cast<std::size_t>(i) + 1) * all.size() / (2 * static_cast<std::size_t>(places));
    const Noise noise = noiseAt(tracer, all[number], number, seeds);
    if (!(noise.light > 0.0 && noise.deviation > 0.0)) continue;
    relative.push_back(noise.deviation / noise.light);
    stated.push_back(noise.stated / noise.deviation);
    inLobes.push_back(noise.inLobes / noise.light);
  }
  const double each = (seconds() - start) / (places * seeds);
  const auto print = [](const char* what, std::vector<double> values, double unit) {
    std::sort(values.begin(), values.end());
    double mean = 0.0;
    for (const double v : values) mean += v / static_cast<double>(values.size());
    std::printf("%-28s mean %.2f  median %.2f  90%% %.2f\n", what, unit * mean,
                unit * values[values.size() / 2], unit * values[values.size() * 9 / 10]);
  };
  if (relative.empty()) throw InputError("no light anywhere");
  print("deviation, per cent", relative, 100.0);
  print("stated error over that", stated, 1.0);
  print("deviation in lobes, per cent", inLobes, 100.0);
  std::printf("processor time, ms a record  %.2f\n", 1e3 * each);
}

}  // namespace
}  // namespace promenade

int main(int argc, char** argv) {
  if (argc < 5 || argc > 7) {
    std::fputs("Usage: record_noise SCENE LIGHT-SOLUTION sky|none bright|plain [PLACES [SEEDS]]\n", stderr);
    return 2;
  }
  try {
    promenade::run({argv + 1, argv + argc});
  } catch (const promenade::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
