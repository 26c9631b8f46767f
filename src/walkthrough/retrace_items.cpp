#include "src/walkthrough/retrace_items.h"

#include <utility>

#include "ibr/view_layer.h"

namespace promenade::walkthrough {
namespace {

/// One sample of each pixel, at another place in its neighbours: renderers may give samples that share a
/// place in the pixel the same random numbers, whose error would not average out.
bool isFirstOfPixel(int x, int y, int supersample) {
  const int pixelX = x / supersample;
  const int pixelY = y / supersample;
  return x % supersample == (pixelX + pixelY) % supersample && y % supersample == pixelY % supersample;
}

}  // namespace

RetracedItems retraceItems(Frame frame, const Mask& items, const ItemSet& matt, int supersample,
                           int frameIndex, const Renderer& renderer) {
  const Size size = items.size();
  RetracedItems retraced{std::move(frame), Mask(size)};
  Mask known(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const bool isFirst =
          isFirstOfPixel(x, y, supersample) || matt.contains(retraced.frame.visibility.item(x, y));
      retraced.traced(x, y) = items(x, y) != 0 && isFirst ? 1 : 0;
      known(x, y) =
          retraced.traced(x, y) != 0 || retraced.frame.source(x, y) == SampleSource::kTracedHole ? 1 : 0;
    }
  }
  renderer.retrace(retraced.frame, retraced.traced, SampleSource::kTracedItem, frameIndex);
  if (supersample == 1) return retraced;

  const ibr::ViewLayer layer = ibr::interpolateViewLayer(
      retraced.frame, known, items,
      {.reach = supersample, .noise = [&](ItemId item) { return renderer.traits(item).noise; }});
  Mask rest(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      if (items(x, y) == 0 || retraced.traced(x, y) != 0) continue;
      if (layer.found(x, y) != 0) {
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
