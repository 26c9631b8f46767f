#include "src/app/compare_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "aqm/predecessors.h"
#include "src/app/values.h"

namespace promenade::app {
namespace {

constexpr Metric kAll[] = {Metric::kAqm,  Metric::kAqm2000, Metric::kRevised, Metric::kVdp,   Metric::kRmse,
                           Metric::kPsnr, Metric::kModel1,  Metric::kModel2,  Metric::kModel3};

// Calls use(i) for every pixel that counts; how many do.
template <class Use>
double forCounted(std::size_t pixels, const Mask& excluded, const Use& use) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    if (!excluded.empty() && excluded.pixels()[i] != 0) continue;
    use(i);
    ++count;
  }
  return static_cast<double>(count);
}

struct Extent {
  double mean = 0.0;
  double most = 0.0;
};

Extent extentOf(std::span<const float> values, const Mask& excluded) {
  Extent extent;
  double sum = 0.0;
  const double count = forCounted(values.size(), excluded, [&](std::size_t i) {
    const auto value = static_cast<double>(values[i]);
    sum += value;
    extent.most = std::max(extent.most, value);
  });
  extent.mean = sum / count;
  return extent;
}

FrameDifference fromSquares(double sumOfSquares, double count) {
  FrameDifference f;
  f.rmse = std::sqrt(sumOfSquares / count);
  f.psnr = f.rmse > 0.0 ? -20.0 * std::log10(f.rmse) : std::numeric_limits<double>::infinity();
  return f;
}

}  // namespace

Metric metricFrom(const std::string& name) {
  const std::string chosen = choiceFrom(
      name, {"aqm", "aqm2000", "revised", "vdp", "rmse", "psnr", "model1", "model2", "model3"}, "--metric");
  return *std::ranges::find(kAll, chosen, [](Metric metric) { return std::string(nameOf(metric)); });
}

FrameDifference visibility(const aqm::Result& result, const Mask& excluded) {
  FrameDifference f;
  f.percentVisible = aqm::percentVisible(result.probability, excluded);
  const Extent jnd = extentOf(result.jnd.pixels(), excluded);
  f.jndMean = jnd.mean;
  f.jndMax = jnd.most;
  f.pooledJndMax = extentOf(result.pooledJnd.pixels(), excluded).most;
  f.probabilityMean = extentOf(result.probability.pixels(), excluded).mean;
  return f;
}

FrameDifference modelDistance(Metric model, const LuminanceMap& test, const LuminanceMap& reference,
                              double pixelsPerDegree) {
  FrameDifference f;
  f.distance = model == Metric::kModel1   ? aqm::rushmeierModel1(test, reference, pixelsPerDegree)
               : model == Metric::kModel2 ? aqm::rushmeierModel2(test, reference, pixelsPerDegree)
                                          : aqm::rushmeierModel3(test, reference, pixelsPerDegree);
  return f;
}

FrameDifference squaredError(const EncodedMap& test, const EncodedMap& reference, const Mask& excluded) {
  double sum = 0.0;
  const auto first = test.pixels();
  const auto second = reference.pixels();
  const double count = forCounted(first.size(), excluded, [&](std::size_t i) {
    const glm::dvec3 d(glm::dvec3(first[i]) - glm::dvec3(second[i]));
    sum += d.x * d.x + d.y * d.y + d.z * d.z;
  });
  return fromSquares(sum, 3.0 * count);
}

FrameDifference squaredError(const LuminanceMap& test, const LuminanceMap& reference, const Mask& excluded) {
  double sum = 0.0;
  double peak = 0.0;
  const auto first = test.pixels();
  const auto second = reference.pixels();
  const double count = forCounted(first.size(), excluded, [&](std::size_t i) {
    const double d = static_cast<double>(first[i]) - static_cast<double>(second[i]);
    peak = std::max({peak, static_cast<double>(first[i]), static_cast<double>(second[i])});
    sum += d * d;
  });
  return fromSquares(sum / (peak * peak), count);
}

}  // namespace promenade::app
