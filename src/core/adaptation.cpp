#include "src/core/adaptation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "src/core/display.h"

namespace promenade {
namespace {

// Nobody adapts to less, and logarithms stay finite.
constexpr double kDarkestAdaptation = 1e-6;

double timeConstant(double luminance) {
  constexpr double kRods = 0.4;
  constexpr double kCones = 0.1;
  const double rods = 0.04 / (0.04 + luminance);
  return rods * kRods + (1.0 - rods) * kCones;
}

/// The share of the way to what it sees, `luminance`, that the eye goes in `seconds`.
double followed(double seconds, double luminance) {
  return 1.0 - std::exp(-seconds / timeConstant(luminance));
}

}  // namespace

std::vector<double> fovealLuminances(const RadianceMap& radiance, int columns) {
  const auto [width, height] = radiance.size();
  columns = std::min(columns, width);
  const int rows = std::clamp(static_cast<int>(std::lround(double(columns) * height / width)), 1, height);
  std::vector<double> luminances;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      double sum = 0.0;
      double count = 0.0;
      for (int y = height * row / rows; y < height * (row + 1) / rows; ++y) {
        for (int x = width * column / columns; x < width * (column + 1) / columns; ++x) {
          const auto l = static_cast<double>(luminance(radiance(x, y)));
          if (!std::isfinite(l)) continue;
          sum += l;
          count += 1.0;
        }
      }
      if (count > 0.0) luminances.push_back(sum / count);
    }
  }
  return luminances;
}

double logAverage(std::vector<double> luminances) {
  if (luminances.empty()) return 0.0;
  std::sort(luminances.begin(), luminances.end());
  const auto count = static_cast<double>(luminances.size());
  const double mean = std::accumulate(luminances.begin(), luminances.end(), 0.0) / count;
  if (!(mean > 0.0)) return 0.0;
  double sum = 0.0;
  for (const double l : luminances) sum += std::log(std::max(l, 1e-2 * mean));
  return std::exp(sum / count);
}

View viewOf(int frame, std::vector<double> luminances, double candelas) {
  for (double& l : luminances) l *= candelas;
  LightHistogram histogram = lightHistogram(luminances);
  return {frame, logAverage(std::move(luminances)), std::move(histogram)};
}

AdaptationCurve::AdaptationCurve(std::vector<View> views, double framesPerSecond) : views_(std::move(views)) {
  assert(!views_.empty() && framesPerSecond > 0.0);
  const auto logOf = [](const View& view) { return std::log(std::max(view.luminance, kDarkestAdaptation)); };
  states_.reserve(static_cast<std::size_t>(views_.back().frame - views_.front().frame + 1));
  double now = std::exp(logOf(views_.front()));
  std::size_t next = 1;
  for (int frame = views_.front().frame; frame <= views_.back().frame; ++frame) {
    while (next < views_.size() && views_[next].frame < frame) ++next;
    const View& before = views_[next - 1];
    const View& after = views_[std::min(next, views_.size() - 1)];
    const double t = after.frame > before.frame
                         ? static_cast<double>(frame - before.frame) / (after.frame - before.frame)
                         : 0.0;
    const double steady = std::exp(logOf(before) + t * (logOf(after) - logOf(before)));
    if (!states_.empty()) {
      now += (steady - now) * followed(1.0 / framesPerSecond, steady);
    }
    states_.push_back({steady, now});
  }
  for (const View& view : views_) {
    const bool isFirst = histograms_.empty();
    const double seconds =
        isFirst ? 0.0 : (view.frame - views_[histograms_.size() - 1].frame) / framesPerSecond;
    histograms_.push_back(isFirst ? view.histogram
                                  : mixed(histograms_.back(), view.histogram,
                                          followed(seconds, std::max(view.luminance, kDarkestAdaptation))));
  }
}

Adaptation AdaptationCurve::at(int frame) const {
  if (states_.empty()) return {};
  const int last = static_cast<int>(states_.size()) - 1;
  return states_[static_cast<std::size_t>(std::clamp(frame - views_.front().frame, 0, last))];
}

LightHistogram AdaptationCurve::histogramAt(int frame) const {
  if (views_.empty()) return {};
  const auto after = std::upper_bound(views_.begin(), views_.end(), frame,
                                      [](int wanted, const View& view) { return wanted < view.frame; });
  if (after == views_.begin()) return histograms_.front();
  if (after == views_.end()) return histograms_.back();
  const auto i = static_cast<std::size_t>(after - views_.begin());
  const double t = static_cast<double>(frame - views_[i - 1].frame) / (views_[i].frame - views_[i - 1].frame);
  return mixed(histograms_[i - 1], histograms_[i], t);
}

std::vector<int> framesToView(int first, int last, double framesPerSecond) {
  constexpr double kViewsPerSecond = 8.0;
  const int step = std::max(1, static_cast<int>(std::ceil(framesPerSecond / kViewsPerSecond)));
  std::vector<int> frames;
  for (int frame = first; frame < last; frame += step) frames.push_back(frame);
  frames.push_back(last);
  return frames;
}

}  // namespace promenade
