#include "aqm/spectrum.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

namespace promenade::aqm {
namespace {

/// Rows of the spectrum that are transposed together: eight complex floats are one cache line.
constexpr int kRowsTransformed = 8;

}  // namespace

Spectrum spectrumOf(const ContrastMap& contrast, const Layout& layout, const FourierPlans& plans) {
  const int width = layout.padded.width;
  const int height = layout.padded.height;
  const int columns = layout.spectrumColumns();

  std::vector<std::size_t> sources(static_cast<std::size_t>(width));
  for (int x = 0; x < width; ++x) {
    sources[static_cast<std::size_t>(x)] =
        static_cast<std::size_t>(reflected(x - layout.margin, layout.image.width));
  }

  Spectrum transposed(height, columns);
  const int blocks = (height + kRowsTransformed - 1) / kRowsTransformed;
  tbb::parallel_for(0, blocks, [&](int block) {
    Plane<float> extended(width, 1);
    Plane<std::complex<float>> rows(columns, kRowsTransformed);
    const int begin = block * kRowsTransformed;
    const int count = std::min(kRowsTransformed, height - begin);
    for (int i = 0; i < count; ++i) {
      const auto source = contrast.row(reflected(begin + i - layout.margin, layout.image.height));
      std::transform(sources.begin(), sources.end(), extended.row(0),
                     [&](std::size_t x) { return source[x]; });
      plans.forwardRow(extended.row(0), rows.row(i));
    }
    for (int ix = 0; ix < columns; ++ix) {
      for (int i = 0; i < count; ++i) {
        transposed.row(ix)[begin + i] = rows.row(i)[ix];
      }
    }
  });

  Spectrum spectrum(height, columns);
  tbb::parallel_for(0, columns, [&](int ix) { plans.forwardColumn(transposed.row(ix), spectrum.row(ix)); });
  return spectrum;
}

}  // namespace promenade::aqm
