// Departures from the paper. Its loop trims the histogram's bins to ceilings until little is left to trim,
// and gives up where nothing is left. What the loop tends to is found directly: of the slope d log Ld / d log
// Lw, which is proportional to a bin's share and has the ceiling (dL(Ld) / Ld) / (dL(Lw) / Lw), the factor of
// proportionality at which black to white is filled. So the curve changes smoothly with the histogram. Where
// the ceilings alone leave some of the display's range, the paper goes over to a linear map; here the
// ceilings are the slope (every visible difference stays as visible as it is), and the luminance that the eye
// is adapted to goes where Ward's factor puts it, as far as everything stays between black and white.

#include "src/core/histogram_adjustment.h"

#include <algorithm>
#include <cmath>

#include "src/core/ferwerda.h"

namespace promenade {
namespace {

// A bin with half a per cent of the light keeps its contrast where there is room; one with less, less, so
// that the first light in a bin does not move everything.
constexpr double kMostFactor = 200.0;
constexpr int kBisections = 50;

/// dL(L) / L of a luminance with the logarithm x.
double leastContrast(double x) {
  const double luminance = std::pow(10.0, x);
  return leastVisible(luminance) / luminance;
}

/// The middle of the last of many halves of [low, high]: where `isBelow` ceases to hold.
template <class IsBelow>
double bisected(double low, double high, const IsBelow& isBelow) {
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (low + high);
    (isBelow(middle) ? low : high) = middle;
  }
  return low;
}

class Slopes {
 public:
  Slopes(const LightHistogram& histogram, int first, int last) {
    for (int bin = first; bin < last; ++bin) {
      const auto i = static_cast<std::size_t>(bin);
      shares_.push_back(0.5 * (histogram.shares[i] + histogram.shares[i + 1]));
      contrasts_.push_back(leastContrast(LightHistogram::logOfBin(bin) + 0.5 * LightHistogram::kStep));
    }
  }

  /// The curve that begins at `start`; its slope is `factor` times the share, up to the ceiling.
  [[nodiscard]] std::vector<double> curve(double start, double factor) const {
    std::vector<double> nodes = {start};
    for (std::size_t i = 0; i < shares_.size(); ++i) {
      const double ceiling = leastContrast(nodes.back()) / contrasts_[i];
      nodes.push_back(nodes.back() + std::min(factor * shares_[i], ceiling) * LightHistogram::kStep);
    }
    return nodes;
  }

 private:
  std::vector<double> shares_;
  std::vector<double> contrasts_;
};

double interpolated(const std::vector<double>& nodes, double place) {
  const double last = static_cast<double>(nodes.size()) - 1.0;
  // What is darker or brighter than everything in the histogram keeps its contrast.
  if (place <= 0.0) return nodes.front() + place * LightHistogram::kStep;
  if (place >= last) return nodes.back() + (place - last) * LightHistogram::kStep;
  const auto i = static_cast<std::size_t>(place);
  return nodes[i] + (place - static_cast<double>(i)) * (nodes[i + 1] - nodes[i]);
}

double placeOf(double luminance, int first) {
  return (std::log10(luminance) - LightHistogram::logOfBin(first)) / LightHistogram::kStep;
}

}  // namespace

double leastVisible(double luminance) {
  return std::min(coneThreshold(luminance), rodThreshold(luminance));
}

HistogramAdjustment::HistogramAdjustment(const LightHistogram& histogram, DisplayRange display,
                                         double worldAdaptation, double displayAdaptation) {
  const double black = std::log10(display.dark);
  const double white = std::log10(display.white);
  const double shown =
      std::log10(worldAdaptation * leastVisible(displayAdaptation) / leastVisible(worldAdaptation));
  const auto& shares = histogram.shares;
  const auto hasLight = [](double share) { return share > 0.0; };
  if (std::none_of(shares.begin(), shares.end(), hasLight)) {
    const double adapted = std::log10(worldAdaptation);
    first_ = static_cast<int>(std::lround((adapted - LightHistogram::kLowest) / LightHistogram::kStep));
    nodes_ = {std::clamp(shown, black, white) + LightHistogram::logOfBin(first_) - adapted};
    return;
  }
  // With the bin on either side: a segment between two bins has the mean of their shares, so that one with
  // light at a single luminance has a width.
  const auto first = std::find_if(shares.begin(), shares.end(), hasLight) - shares.begin();
  const auto end = shares.rend() - std::find_if(shares.rbegin(), shares.rend(), hasLight);
  first_ = std::max(static_cast<int>(first) - 1, 0);
  const int last = std::min(static_cast<int>(end), LightHistogram::kBins - 1);
  const Slopes slopes(histogram, first_, last);
  const auto fits = [&](double start, double factor) { return slopes.curve(start, factor).back() <= white; };
  if (!fits(black, kMostFactor)) {
    const double logFactor = bisected(-6.0, std::log10(kMostFactor),
                                      [&](double exponent) { return fits(black, std::pow(10.0, exponent)); });
    nodes_ = slopes.curve(black, std::pow(10.0, logFactor));
    return;
  }
  const double highest = bisected(black, white, [&](double start) { return fits(start, kMostFactor); });
  const double wanted = bisected(black, white, [&](double start) {
    return interpolated(slopes.curve(start, kMostFactor), placeOf(worldAdaptation, first_)) <= shown;
  });
  nodes_ = slopes.curve(std::min(wanted, highest), kMostFactor);
}

double HistogramAdjustment::operator()(double worldLuminance) const {
  if (!(worldLuminance > 0.0)) return 0.0;
  return std::pow(10.0, interpolated(nodes_, placeOf(worldLuminance, first_)));
}

}  // namespace promenade
