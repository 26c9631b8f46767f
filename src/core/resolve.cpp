#include "src/core/resolve.h"

#include <array>
#include <cassert>

namespace promenade {
namespace {

Size displaySize(Size samples, int factor) {
  assert(factor >= 1 && samples.width % factor == 0 && samples.height % factor == 0);
  return {samples.width / factor, samples.height / factor};
}

}  // namespace

RadianceMap resolveRadiance(const RadianceMap& samples, int factor) {
  RadianceMap pixels(displaySize(samples.size(), factor));
  const float weight = 1.0f / static_cast<float>(factor * factor);
  for (int y = 0; y < pixels.height(); ++y) {
    for (int x = 0; x < pixels.width(); ++x) {
      Rgb sum(0.0f);
      for (int j = 0; j < factor; ++j) {
        for (int i = 0; i < factor; ++i) sum += samples(x * factor + i, y * factor + j);
      }
      pixels(x, y) = sum * weight;
    }
  }
  return pixels;
}

Visibility resolveVisibility(const Visibility& samples, int factor) {
  const Size size = displaySize(samples.depth.size(), factor);
  const Camera& c = samples.camera;
  Visibility pixels{
      Camera(c.pose(), c.verticalFieldOfView(), size, c.subpixelOffset() / static_cast<double>(factor)),
      DepthMap(size), NormalMap(size), ItemBuffer(size)};
  // The samples around the pixel's centre: one for an odd factor, four for an even one.
  const int first = (factor - 1) / 2;
  const int last = factor / 2;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      int bestX = x * factor + first;
      int bestY = y * factor + first;
      for (int j = first; j <= last; ++j) {
        for (int i = first; i <= last; ++i) {
          const int sx = x * factor + i;
          const int sy = y * factor + j;
          if (samples.depth(sx, sy) < samples.depth(bestX, bestY)) {
            bestX = sx;
            bestY = sy;
          }
        }
      }
      pixels.depth(x, y) = samples.depth(bestX, bestY);
      pixels.normal(x, y) = samples.normal(bestX, bestY);
      pixels.item(x, y) = samples.item(bestX, bestY);
    }
  }
  return pixels;
}

SourceMap resolveSource(const SourceMap& samples, int factor) {
  SourceMap pixels(displaySize(samples.size(), factor));
  for (int y = 0; y < pixels.height(); ++y) {
    for (int x = 0; x < pixels.width(); ++x) {
      std::array<int, 7> votes{};
      for (int j = 0; j < factor; ++j) {
        for (int i = 0; i < factor; ++i) {
          ++votes[static_cast<std::size_t>(samples(x * factor + i, y * factor + j))];
        }
      }
      std::size_t winner = 0;
      for (std::size_t k = 1; k < votes.size(); ++k) {
        if (votes[k] >= votes[winner]) winner = k;
      }
      pixels(x, y) = static_cast<SampleSource>(winner);
    }
  }
  return pixels;
}

}  // namespace promenade
