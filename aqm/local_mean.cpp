#include "aqm/local_mean.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "aqm/contrast.h"
#include "aqm/cortex.h"

namespace promenade::aqm {
namespace {

/// The low-pass filter rings; beside a light source it could pass below zero.
constexpr float kLeastMean = 0.1f;

}  // namespace

Plane<float> localMeans(const Spectrum& spectrum, const Layout& layout, const FourierPlans& plans,
                        double adaptation) {
  const int width = layout.padded.width;
  const int height = layout.padded.height;
  const double edge = std::ldexp(1.0, -layout.bands);
  const double scale = 0.37 * (1.0 - coneResponse(adaptation)) / static_cast<double>(layout.padded.area());

  Spectrum columns(height, layout.spectrumColumns());
  tbb::parallel_for(0, layout.spectrumColumns(), [&](int ix) {
    Spectrum filtered(height, 1);
    for (int iy = 0; iy < height; ++iy) {
      const double f = std::hypot(signedFrequency(ix, width), signedFrequency(iy, height));
      filtered.row(0)[iy] = spectrum.row(ix)[iy] * static_cast<float>(scale * mesa(f, edge));
    }
    plans.inverseColumn(filtered.row(0), columns.row(ix));
  });

  Plane<float> means(layout.image.width, layout.image.height);
  tbb::parallel_for(0, layout.image.height, [&](int y) {
    Spectrum row(layout.spectrumColumns(), 1);
    Plane<float> relative(width, 1);
    for (int ix = 0; ix < layout.spectrumColumns(); ++ix) {
      row.row(0)[ix] = columns.row(ix)[y + layout.margin];
    }
    plans.inverseRow(row.row(0), relative.row(0));
    std::transform(relative.row(0) + layout.margin, relative.row(0) + layout.margin + layout.image.width,
                   means.row(y), [](float value) { return std::max(kLeastMean, 1.0f + value); });
  });
  return means;
}

}  // namespace promenade::aqm
