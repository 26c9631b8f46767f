#include "ibr/depth_raster.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace promenade::ibr {
namespace {

/// Rows of the target that one task draws.
constexpr int kBand = 16;

struct Range {
  float low = std::numeric_limits<float>::infinity();
  float high = -std::numeric_limits<float>::infinity();
  void include(float value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// First and one past the last sample whose centre lies in [low, high], within [begin, end).
struct Samples {
  int begin;
  int end;
};
Samples samplesIn(const Range& range, int begin, int end) {
  const float first =
      std::clamp(std::ceil(range.low - 0.5f), static_cast<float>(begin), static_cast<float>(end));
  const float last =
      std::clamp(std::floor(range.high - 0.5f) + 1.0f, static_cast<float>(begin), static_cast<float>(end));
  return {static_cast<int>(first), static_cast<int>(last)};
}

float cross(glm::vec2 a, glm::vec2 b) {
  return a.x * b.y - a.y * b.x;
}

class RasterBand {
 public:
  RasterBand(Rastered& out, Image<float>& nearest, int begin, int end)
      : out_(out), nearest_(nearest), begin_(begin), end_(end) {}

  void draw(const Patch& patch) const {
    const auto& [a, b, c] = patch.corners;
    Range rows;
    Range columns;
    for (const Corner& corner : patch.corners) {
      rows.include(corner.pixel.y);
      columns.include(corner.pixel.x);
    }
    const Samples ys = samplesIn(rows, begin_, end_);
    const Samples xs = samplesIn(columns, 0, nearest_.width());
    if (ys.begin >= ys.end || xs.begin >= xs.end) return;
    const float area = cross(b.pixel - a.pixel, c.pixel - a.pixel);
    if (area == 0.0f) return;
    // A hair more than the triangle: two that share an edge must not leave out a sample upon it.
    const float slack = -1e-4f;
    for (int y = ys.begin; y < ys.end; ++y) {
      for (int x = xs.begin; x < xs.end; ++x) {
        const glm::vec2 p(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
        const float wb = cross(p - a.pixel, c.pixel - a.pixel) / area;
        const float wc = cross(b.pixel - a.pixel, p - a.pixel) / area;
        const float wa = 1.0f - wb - wc;
        if (!(wa >= slack && wb >= slack && wc >= slack)) continue;
        put(x, y, std::max(0.0f, wa * a.inverseDepth + wb * b.inverseDepth + wc * c.inverseDepth), patch);
      }
    }
  }

 private:
  void put(int x, int y, float inverseDepth, const Patch& patch) const {
    if (!(inverseDepth > nearest_(x, y))) return;
    nearest_(x, y) = inverseDepth;
    out_.covered(x, y) = 1;
    out_.visibility.depth(x, y) =
        patch.item == kNoItem ? std::numeric_limits<float>::infinity() : 1.0f / inverseDepth;
    out_.visibility.normal(x, y) = patch.normal;
    out_.visibility.item(x, y) = patch.item;
  }

  Rastered& out_;
  Image<float>& nearest_;
  int begin_;
  int end_;
};

}  // namespace

Rastered raster(const SurfacePatches& patches, const Camera& target) {
  const Size size = target.size();
  Rastered out{
      {target, DepthMap(size, std::numeric_limits<float>::infinity()), NormalMap(size), ItemBuffer(size)},
      Mask(size)};
  Image<float> nearest(size, -1.0f);  // background, at 0, is nearer than nothing

  // Patches are made anew for every band that their row touches, instead of being stored: a fixed order and
  // no more memory, however large the frame.
  const int firstRow = patches.firstRow();
  std::vector<Range> rows(static_cast<std::size_t>(patches.endRow() - firstRow));
  tbb::parallel_for(firstRow, patches.endRow(), [&](int row) {
    Range& range = rows[static_cast<std::size_t>(row - firstRow)];
    patches.forEachInRow(row, [&](const Patch& patch) {
      for (const Corner& corner : patch.corners) range.include(corner.pixel.y);
    });
  });
  tbb::parallel_for(0, (size.height + kBand - 1) / kBand, [&](int index) {
    const int begin = index * kBand;
    const int end = std::min(size.height, begin + kBand);
    const RasterBand band(out, nearest, begin, end);
    for (int row = firstRow; row < patches.endRow(); ++row) {
      const Range& range = rows[static_cast<std::size_t>(row - firstRow)];
      if (!(range.high >= static_cast<float>(begin) && range.low <= static_cast<float>(end))) continue;
      patches.forEachInRow(row, [&](const Patch& patch) { band.draw(patch); });
    }
  });
  return out;
}

}  // namespace promenade::ibr
