#include "aqm/fast_filters.h"

#include <hwy/highway.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "aqm/passband.h"

namespace promenade::aqm {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::CappedTag<float, 8>;

/// Signed frequencies of all rows, cycles per pixel; 0 between them and the end of the plane's row.
Plane<float> rowFrequencies(int height, int step) {
  Plane<float> result(height, 1);
  for (int iy = 0; iy < height; ++iy) {
    result.row(0)[iy] = static_cast<float>(signedFrequency(iy, height) / step);
  }
  return result;
}

/// FilterBank::fan for Daly's six orientations (see squaredFan in cortex.cpp), but for Nyquist's frequencies.
void sixthFan(double fx, const Plane<float>& rowFrequency, int orientation, bool squared, float* to) {
  const Lanes tag;
  const auto across = acrossBars(orientation);
  const auto ax = hn::Set(tag, static_cast<float>(fx * across.x));
  const auto ay = hn::Set(tag, static_cast<float>(across.y));
  const auto xx = hn::Set(tag, static_cast<float>(fx * fx));
  for (int iy = 0; iy < rowFrequency.stride(); iy += static_cast<int>(hn::Lanes(tag))) {
    const auto fy = hn::Load(tag, rowFrequency.row(0) + iy);
    const auto along = hn::MulAdd(fy, ay, ax);
    const auto length = hn::Max(hn::MulAdd(fy, fy, xx), hn::Set(tag, 1e-20f));
    const auto cosine = hn::Min(hn::Set(tag, 1.0f), hn::Div(hn::Mul(along, along), length));
    const auto factor = hn::Max(hn::Zero(tag), hn::MulSub(hn::Set(tag, 4.0f), cosine, hn::Set(tag, 3.0f)));
    const auto amplitude = hn::Mul(hn::Sqrt(cosine), factor);
    hn::Store(squared ? hn::Mul(amplitude, amplitude) : amplitude, tag, to + iy);
  }
}

}  // namespace

Plane<float> fanPlane(const FilterBank& filters, int orientation, const Layout& layout) {
  const Size padded = layout.padded;
  Plane<float> fan(padded.height, layout.spectrumColumns());
  const Plane<float> rowFrequency = rowFrequencies(padded.height, 1);
  const bool isSquared = filters.fansAreSquared();
  tbb::parallel_for(0, layout.spectrumColumns(), [&](int ix) {
    float* to = fan.row(ix);
    if (orientation == kUnoriented) {
      std::fill_n(to, padded.height, 1.0f);
      return;
    }
    Frequency frequency{signedFrequency(ix, padded.width), 0.0, 2 * ix == padded.width, false};
    const auto fill = [&](int begin, int end) {
      for (int iy = begin; iy < end; ++iy) {
        frequency.y = signedFrequency(iy, padded.height);
        frequency.yIsNyquist = 2 * iy == padded.height;
        to[iy] = static_cast<float>(filters.fan(frequency, orientation));
      }
    };
    if (filters.orientations() != kOrientations || frequency.xIsNyquist) {
      fill(0, padded.height);
      return;
    }
    sixthFan(frequency.x, rowFrequency, orientation, isSquared, to);
    fill(0, 1);
    if (padded.height % 2 == 0) {
      fill(padded.height / 2, padded.height / 2 + 1);
    }
  });
  return fan;
}

std::vector<Plane<float>> radialPlanes(const FilterBank& filters, int band, const SpeedTerms& terms,
                                       const Layout& layout, const Grid& grid) {
  const int height = grid.padded.height;
  const double perColumn = static_cast<double>(grid.padded.width) * grid.step;
  const int columns = std::min(grid.padded.width / 2 + 1,
                               static_cast<int>(std::floor(filters.highest(band) * perColumn)) + 1);
  // One more sample than are read, so that the last has a neighbour.
  std::vector<std::vector<float>> tables = terms.shapes;
  const auto scale = static_cast<float>(1.0 / static_cast<double>(layout.padded.area()));
  std::vector<Plane<float>> planes;
  for (std::vector<float>& table : tables) {
    for (float& value : table) value *= scale;
    table.push_back(0.0f);
    planes.emplace_back(height, columns);
  }
  const Plane<float> rowFrequency = rowFrequencies(height, grid.step);
  const auto perSample = static_cast<float>((kShapeSamples - 1) / (terms.highest - terms.lowest));
  const auto lowest = static_cast<float>(terms.lowest);
  tbb::parallel_for(0, columns, [&](int ix) {
    const auto fx = static_cast<float>(ix / perColumn);
    const PassedRows rows = passedRows(filters, band, kUnoriented, ix, grid.padded, grid.step);
    for (const Interval interval : {rows.positive, rows.negative}) {
      for (int iy = interval.begin; iy < interval.end; ++iy) {
        const float fy = rowFrequency.row(0)[iy];
        const float position = (std::sqrt(fx * fx + fy * fy) - lowest) * perSample;
        if (position < 0.0f || position > static_cast<float>(kShapeSamples - 1)) {
          continue;
        }
        const auto sample = static_cast<std::size_t>(position);
        const float rest = position - static_cast<float>(sample);
        for (std::size_t m = 0; m < planes.size(); ++m) {
          const float* table = tables[m].data() + sample;
          planes[m].row(ix)[iy] = table[0] + rest * (table[1] - table[0]);
        }
      }
    }
  });
  return planes;
}

}  // namespace promenade::aqm
