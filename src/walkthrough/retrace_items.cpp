#include "src/walkthrough/retrace_items.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "ibr/view_layer.h"
#include "src/core/display.h"

namespace promenade::walkthrough {
namespace {

/// One sample of each pixel, at another place in its neighbours: renderers may give samples that share a
/// place in the pixel the same random numbers, whose error would not average out.
bool isFirstOfPixel(int x, int y, int supersample) {
  const int pixelX = x / supersample;
  const int pixelY = y / supersample;
  return x % supersample == (pixelX + pixelY) % supersample && y % supersample == pixelY % supersample;
}

/// Detail finer than the traced samples shows in the warped layer, which is known at all of them: what they
/// would make of it is not what it is.
class WarpedDetail {
 public:
  /// `traced`: the samples that will be known; of the warped layer they are known, too.
  WarpedDetail(const Frame& warped, const Mask& traced, const Mask& items,
               const ibr::ViewLayerSettings& settings)
      : settings_(settings),
        warped_(warped.viewDependent.clone()),
        expected_(ibr::interpolateViewLayer(warped, traced, items, settings)) {}

  [[nodiscard]] bool isBetweenSamplesAround(const Frame& frame, int x, int y) const {
    if (expected_.found(x, y) == 0) return true;
    const float bright = luminance(warped_(x, y));
    const double noise = settings_.noise(frame.visibility.item(x, y));
    const double largest = (settings_.largestRange + 3.0 * noise) * (bright + luminance(frame.diffuse(x, y)));
    return std::abs(luminance(expected_.viewDependent(x, y)) - bright) > largest;
  }

 private:
  const ibr::ViewLayerSettings& settings_;
  RadianceMap warped_;
  ibr::ViewLayer expected_;
};

}  // namespace

RetracedItems retraceItems(Frame frame, const Mask& items, const ItemSet& matt, int supersample,
                           int frameIndex, const Renderer& renderer) {
  const Size size = items.size();
  RetracedItems retraced{std::move(frame), Mask(size)};
  if (std::ranges::none_of(items.pixels(), [](std::uint8_t v) { return v != 0; })) return retraced;
  Mask known(size);
  // Of what has no view-dependent layer to speak of it is the diffuse one that is wrong.
  const auto isTracedFirst = [&](int x, int y) {
    const ItemId item = retraced.frame.visibility.item(x, y);
    return isFirstOfPixel(x, y, supersample) || matt.contains(item) || !renderer.traits(item).viewDependent;
  };
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      retraced.traced(x, y) = items(x, y) != 0 && isTracedFirst(x, y) ? 1 : 0;
      known(x, y) =
          retraced.traced(x, y) != 0 || retraced.frame.source(x, y) == SampleSource::kTracedHole ? 1 : 0;
    }
  }
  const ibr::ViewLayerSettings settings{.reach = supersample,
                                        .noise = [&](ItemId item) { return renderer.traits(item).noise; }};
  std::optional<WarpedDetail> detail;
  if (supersample > 1) detail.emplace(retraced.frame, retraced.traced, items, settings);
  renderer.retrace(retraced.frame, retraced.traced, SampleSource::kTracedItem, frameIndex);
  if (!detail) return retraced;

  const ibr::ViewLayer layer = ibr::interpolateViewLayer(retraced.frame, known, items, settings);
  Mask rest(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      if (items(x, y) == 0 || retraced.traced(x, y) != 0) continue;
      if (layer.found(x, y) != 0 && !detail->isBetweenSamplesAround(retraced.frame, x, y)) {
        retraced.frame.viewDependent(x, y) = layer.viewDependent(x, y);
      } else {
        rest(x, y) = retraced.traced(x, y) = 1;
      }
    }
  }
  renderer.retrace(retraced.frame, rest, SampleSource::kTracedItem, frameIndex);
  return retraced;
}

}  // namespace promenade::walkthrough
