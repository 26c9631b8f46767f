#include "src/app/compare_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "aqm/predecessors.h"
#include "src/app/values.h"

namespace promenade::app {
namespace {

constexpr Metric kAll[] = {Metric::kAqm,  Metric::kAqm2000, Metric::kRevised, Metric::kVdp,   Metric::kRmse,
                           Metric::kPsnr, Metric::kModel1,  Metric::kModel2,  Metric::kModel3};

double meanOf(std::span<const float> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double maxOf(std::span<const float> values) {
  return static_cast<double>(*std::max_element(values.begin(), values.end()));
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

aqm::Eye eyeFrom(const std::string& name) {
  const std::string chosen = choiceFrom(name, {"tracking", "fixating", "stabilised"}, "--eye");
  return chosen == "fixating"     ? aqm::Eye::kFixating
         : chosen == "stabilised" ? aqm::Eye::kStabilised
                                  : aqm::Eye::kTracking;
}

bool knowsOfMotion(Metric metric) {
  return metric == Metric::kAqm || metric == Metric::kAqm2000 || metric == Metric::kRevised;
}

aqm::Settings settingsOf(Metric metric, const Viewer& viewer) {
  const double ppd = viewer.pixelsPerDegree;
  aqm::Settings settings = metric == Metric::kAqm2000   ? aqm::aqm2000(ppd)
                           : metric == Metric::kRevised ? aqm::revisedAqm(ppd)
                           : metric == Metric::kVdp     ? aqm::vdp(ppd, viewer.distanceMetres)
                                                        : aqm::aqm(ppd);
  settings.eye = viewer.eye;
  settings.execution = aqm::Execution::kPlain;
  return settings;
}

FrameDifference visibility(const aqm::Result& result) {
  FrameDifference f;
  f.percentVisible = aqm::percentVisible(result.probability, Mask());
  f.jndMean = meanOf(result.jnd.pixels());
  f.jndMax = maxOf(result.jnd.pixels());
  f.pooledJndMax = maxOf(result.pooledJnd.pixels());
  f.probabilityMean = meanOf(result.probability.pixels());
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

FrameDifference squaredError(const EncodedMap& test, const EncodedMap& reference) {
  double sum = 0.0;
  const auto first = test.pixels();
  const auto second = reference.pixels();
  for (std::size_t i = 0; i < first.size(); ++i) {
    const glm::dvec3 d(glm::dvec3(first[i]) - glm::dvec3(second[i]));
    sum += d.x * d.x + d.y * d.y + d.z * d.z;
  }
  return fromSquares(sum, 3.0 * static_cast<double>(first.size()));
}

FrameDifference squaredError(const LuminanceMap& test, const LuminanceMap& reference) {
  double sum = 0.0;
  double peak = 0.0;
  const auto first = test.pixels();
  const auto second = reference.pixels();
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double d = static_cast<double>(first[i]) - static_cast<double>(second[i]);
    peak = std::max({peak, static_cast<double>(first[i]), static_cast<double>(second[i])});
    sum += d * d;
  }
  return fromSquares(sum / (peak * peak), static_cast<double>(first.size()));
}

}  // namespace promenade::app
