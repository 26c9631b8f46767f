#include "src/walkthrough/stopping.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <numbers>
#include <utility>

#include "src/core/resolve.h"
#include "src/walkthrough/seen.h"
#include "src/walkthrough/selected.h"

namespace promenade::walkthrough {
namespace {

/// Pooled JND at which a viewer is counted as seeing a difference: P = 1 - exp(-Jp^3.5).
const double kVisibleJnd = std::pow(-std::log(1.0 - aqm::kVisibleProbability), 1.0 / 3.5);

/// The display pixels and samples of square tiles.
class Tiles {
 public:
  explicit Tiles(const Settings& settings)
      : size_(settings.size), edge_(settings.stopping->tile), supersample_(settings.supersample) {}

  /// visit(left, top, right, bottom) in display pixels, right and bottom exclusive.
  template <class Visit>
  void forEach(const Visit& visit) const {
    for (int top = 0; top < size_.height; top += edge_) {
      for (int left = 0; left < size_.width; left += edge_) {
        visit(left, top, std::min(left + edge_, size_.width), std::min(top + edge_, size_.height));
      }
    }
  }
  [[nodiscard]] bool anySample(const Mask& samples, int left, int top, int right, int bottom) const {
    for (int y = top * supersample_; y < bottom * supersample_; ++y) {
      const auto row = samples.row(y).subspan(static_cast<std::size_t>(left * supersample_),
                                              static_cast<std::size_t>((right - left) * supersample_));
      if (std::any_of(row.begin(), row.end(), [](std::uint8_t v) { return v != 0; })) return true;
    }
    return false;
  }
  void clearSamples(Mask& samples, int left, int top, int right, int bottom) const {
    for (int y = top * supersample_; y < bottom * supersample_; ++y) {
      for (int x = left * supersample_; x < right * supersample_; ++x) samples(x, y) = 0;
    }
  }

 private:
  Size size_;
  int edge_;
  int supersample_;
};

void copySelected(const RadianceMap& from, const Mask& selected, RadianceMap& to) {
  for (std::size_t i = 0; i < selected.pixels().size(); ++i) {
    if (selected.pixels()[i] != 0) to.pixels()[i] = from.pixels()[i];
  }
}

/// Fewer prove nothing of what lies between them.
constexpr int kLeastNoisy = 4;

/// Samples that are not traced here, beside `noisy` ones of their item that are, will be interpolated between
/// these (retrace_items.h) or are warped from frames with such noise: they get what is interpolated of it by
/// a tent that reaches so many samples to each side.
void spreadNoise(const Mask& traced, const Mask& noisy, const ItemBuffer& item, int reach,
                 const RadianceMap& all, RadianceMap& half) {
  RadianceMap sum(noisy.size(), Rgb(0.0f));
  Image<float> shares(noisy.size());
  Image<int> count(noisy.size());
  for (int y = 0; y < noisy.height(); ++y) {
    for (int x = 0; x < noisy.width(); ++x) {
      if (noisy(x, y) == 0) continue;
      const Rgb noise = half(x, y) - all(x, y);
      for (int j = std::max(y - reach, 0); j <= std::min(y + reach, noisy.height() - 1); ++j) {
        for (int i = std::max(x - reach, 0); i <= std::min(x + reach, noisy.width() - 1); ++i) {
          if (traced(i, j) != 0 || item(i, j) != item(x, y)) continue;
          const auto share = static_cast<float>((reach - std::abs(i - x)) * (reach - std::abs(j - y)));
          sum(i, j) += share * noise;
          shares(i, j) += share;
          ++count(i, j);
        }
      }
    }
  }
  for (std::size_t i = 0; i < sum.pixels().size(); ++i) {
    const float share = shares.pixels()[i];
    if (count.pixels()[i] < kLeastNoisy || share == 0.0f) continue;
    half.pixels()[i] = glm::max(all.pixels()[i] + sum.pixels()[i] / share, Rgb(0.0f));
  }
}

}  // namespace

bool isPredictedVisible(float pooledJnd) {
  // I_T - I_0.5T is half the difference of two independent halves, so its deviation is that of I_T from the
  // converged image. Two frames differ by the root of 2 times as much.
  return std::numbers::sqrt2 * pooledJnd > kVisibleJnd;
}

double predictedPercent(const JndMap& pooledJnd) {
  const auto pixels = pooledJnd.pixels();
  if (pixels.empty()) return 0.0;
  return 100.0 * static_cast<double>(std::count_if(pixels.begin(), pixels.end(), isPredictedVisible)) /
         static_cast<double>(pixels.size());
}

StoppingStatistics traceUntilInvisible(Frame& frame, const Mask& mask, int frameIndex,
                                       const Renderer& renderer, const Settings& settings,
                                       PartSeconds& seconds) {
  assert(settings.stopping);
  const StoppingRule& rule = *settings.stopping;
  const Tiles tiles(settings);
  StoppingStatistics spent;
  const auto trace = [&](const Mask& selected, PathRange paths) {
    const Stopwatch watch(seconds.trace);
    Refined refined = renderer.refine(frame, selected, paths, frameIndex);
    spent.paths += refined.paths;
    return std::move(refined.open);
  };

  Mask open = trace(mask, {0, rule.firstPaths});
  spent.mostPaths = rule.firstPaths;
  if (!isAnySelected(open)) return spent;
  // One for all that is compared here; the means that it is made of have little noise.
  const Surroundings surroundings = surroundingsOf(frame, frameIndex, settings);
  const auto seen = [&](const RadianceMap& samples) {
    return seenOnDisplay(resolveRadiance(samples, settings.supersample), frameIndex, settings, surroundings);
  };
  const Mask noisy = open.clone();
  RadianceMap afterHalf = combinedRadiance(frame);  // of each sample's own paths
  for (int paths = rule.firstPaths; paths <= rule.mostPaths / 2 && isAnySelected(open); paths *= 2) {
    copySelected(combinedRadiance(frame), open, afterHalf);
    Mask goOn = trace(open, {paths, paths});
    spent.mostPaths = 2 * paths;
    spent.openTiles = 0;
    const Stopwatch watch(seconds.metric);
    const RadianceMap afterAll = combinedRadiance(frame);
    spreadNoise(mask, noisy, frame.visibility.item, 2 * settings.supersample, afterAll, afterHalf);
    const JndMap predicted = aqm::compare(seen(afterAll), seen(afterHalf), VelocityMap(),
                                          aqm::Settings{settings.display.pixelsPerDegree()})
                                 .pooledJnd;
    spent.predictedPercent = predictedPercent(predicted);
    tiles.forEach([&](int left, int top, int right, int bottom) {
      if (!tiles.anySample(goOn, left, top, right, bottom)) return;
      int different = 0;
      for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) different += isPredictedVisible(predicted(x, y)) ? 1 : 0;
      }
      if (100.0 * different <= rule.tolerancePercent * (right - left) * (bottom - top)) {
        tiles.clearSamples(goOn, left, top, right, bottom);
      } else {
        ++spent.openTiles;
      }
    });
    open = std::move(goOn);
  }
  return spent;
}

StoppingRenderer::StoppingRenderer(const Renderer& renderer, const Settings& settings)
    : renderer_(renderer), settings_(settings) {}

void StoppingRenderer::trace(Frame& frame, const Mask& mask, int frameIndex) const {
  const StoppingStatistics spent =
      traceUntilInvisible(frame, mask, frameIndex, renderer_, settings_, seconds_);
  spent_.paths += spent.paths;
  spent_.mostPaths = std::max(spent_.mostPaths, spent.mostPaths);
  spent_.predictedPercent = std::min(100.0, spent_.predictedPercent + spent.predictedPercent);
  spent_.openTiles += spent.openTiles;
}

Visibility StoppingRenderer::visibility(const Camera& camera) const {
  return renderer_.visibility(camera);
}

Visibility StoppingRenderer::visibilityAmong(const Camera& camera,
                                             std::span<const Frame* const> known) const {
  return renderer_.visibilityAmong(camera, known);
}

void StoppingRenderer::retrace(Frame& frame, const Mask& mask, SampleSource source, int frameIndex) const {
  trace(frame, mask, frameIndex);
  for (std::size_t i = 0; i < mask.pixels().size(); ++i) {
    if (mask.pixels()[i] != 0) frame.source.pixels()[i] = source;
  }
}

Refined StoppingRenderer::refine(Frame& frame, const Mask& mask, PathRange paths, int frameIndex) const {
  return renderer_.refine(frame, mask, paths, frameIndex);
}

Frame StoppingRenderer::render(const Camera& camera, int frameIndex) const {
  Frame frame = unshaded(renderer_.visibility(camera));
  trace(frame, Mask(frame.diffuse.size(), 1), frameIndex);
  return frame;
}

ItemTraits StoppingRenderer::traits(ItemId item) const {
  return renderer_.traits(item);
}

RayCounts StoppingRenderer::rayCounts() const {
  return renderer_.rayCounts();
}

StoppingStatistics StoppingRenderer::spent() const {
  return std::exchange(spent_, {});
}

}  // namespace promenade::walkthrough
