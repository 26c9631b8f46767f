#include "aqm/grid_masking.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "aqm/masking_rows.h"

namespace promenade::aqm {
namespace {

/// A kernel this narrow is a single weight of 1.
constexpr double kPointSigma = 0.01;

}  // namespace

GridMasking::GridMasking(int band, const Grid& grid, Size image, const Masking& settings)
    : grid_(grid),
      settings_(settings),
      kernel_(settings.extent == MaskExtent::kChannel ? 0.375 * std::ldexp(1.0, band) / grid.step
                                                      : kPointSigma),
      across_(reflectionsOf(image.width, grid.sites.width, grid.step, kernel_.radius())),
      down_(reflectionsOf(image.height, grid.sites.height, grid.step, kernel_.radius())) {
  for (std::size_t frame = 0; frame < 2; ++frame) {
    if (masks(frame)) {
      elevations_[frame] = Plane<float>(grid.sites.width, grid.sites.height + 2 * kernel_.radius());
    }
  }
}

bool GridMasking::masks(std::size_t frame) const {
  const MaskSource other = frame == 0 ? MaskSource::kReference : MaskSource::kTest;
  return settings_.elevation != Elevation::kNone && settings_.source != other;
}

void GridMasking::elevateRow(std::size_t frame, int y, const float* responses, ExtendedRow& extended) {
  const int width = grid_.sites.width;
  float* samples = extended.samples();
  elevateByUnitKnee(responses + grid_.apron, settings_.strength, samples,
                    (width + kPlaneUnit - 1) / kPlaneUnit * kPlaneUnit);
  const auto between = [&](const Reflection& r) {
    return r.weight == 0.0f ? samples[r.site]
                            : samples[r.site] + r.weight * (samples[r.site + 1] - samples[r.site]);
  };
  const int radius = kernel_.radius();
  for (int i = 0; i < radius; ++i) {
    samples[i - radius] = between(across_.before[static_cast<std::size_t>(i)]);
    samples[width + i] = between(across_.after[static_cast<std::size_t>(i)]);
  }
  Plane<float>& to = elevations_[frame];
  kernel_.weightedSum(extended.taps(), to.row(y + radius), to.stride());
}

/// The rows of an elevation beyond the first and the last site.
void GridMasking::extendDown(Plane<float>& elevation) const {
  const int radius = kernel_.radius();
  const auto fill = [&](int y, const Reflection& r) {
    const float* above = elevation.row(radius + r.site);
    const float* below = r.weight == 0.0f ? above : elevation.row(radius + r.site + 1);
    std::transform(above, above + elevation.stride(), below, elevation.row(y),
                   [&](float a, float b) { return a + r.weight * (b - a); });
  };
  for (int i = 0; i < radius; ++i) {
    fill(i, down_.before[static_cast<std::size_t>(i)]);
    fill(radius + grid_.sites.height + i, down_.after[static_cast<std::size_t>(i)]);
  }
}

/// What the differences in columns x .. x + count - 1 of row y of the sites are divided by. `elevations`
/// has a row for each frame; returns those that count.
PerFrame<const float*> GridMasking::divisors(int y, int x, int count, std::vector<const float*>& taps,
                                             Plane<float>& elevations) const {
  PerFrame<const float*> result{elevations.row(2), elevations.row(2)};
  for (std::size_t frame = 0; frame < 2; ++frame) {
    if (masks(frame)) {
      for (std::size_t t = 0; t < taps.size(); ++t) {
        taps[t] = elevations_[frame].row(y + static_cast<int>(t)) + x;
      }
      kernel_.weightedSum(taps.data(), elevations.row(static_cast<int>(frame)), count);
      result[frame] = elevations.row(static_cast<int>(frame));
      if (!masks(1 - frame)) {
        result[1 - frame] = result[frame];
      }
    }
  }
  return result;
}

template <class Body>
void GridMasking::forEachStrip(int height, int stride, const Body& body) const {
  const auto taps = static_cast<std::size_t>(2 * kernel_.radius() + 1);
  const int blocks = (height + kRowsPerBlock - 1) / kRowsPerBlock;
  tbb::parallel_for(0, blocks, [&](int block) {
    Plane<float> elevations(kStripWidth, 3);
    std::fill_n(elevations.row(2), kStripWidth, 1.0f);
    std::vector<const float*> tapped(taps);
    const int end = std::min((block + 1) * kRowsPerBlock, height);
    for (int x = 0; x < stride; x += kStripWidth) {
      const int count = std::min(kStripWidth, stride - x);
      for (int y = block * kRowsPerBlock; y < end; ++y) {
        body(y, x, count, divisors(y, x, count, tapped, elevations));
      }
    }
  });
}

void GridMasking::addPowers(PerFrame<Plane<float>>& responses, Plane<float>& powers) {
  for (std::size_t frame = 0; frame < 2; ++frame) {
    if (masks(frame)) {
      extendDown(elevations_[frame]);
    }
  }
  if (grid_.step == 1) {
    forEachStrip(powers.height(), powers.stride(),
                 [&](int y, int x, int count, const PerFrame<const float*>& divisor) {
                   addDifferences(responses[0].row(y) + x, responses[1].row(y) + x, divisor[0], divisor[1],
                                  powers.row(y) + x, count);
                 });
    return;
  }
  const Size sites = grid_.sites;
  Plane<float> lesser(sites.width, sites.height);
  forEachStrip(sites.height, lesser.stride(),
               [&](int y, int x, int count, const PerFrame<const float*>& divisor) {
                 std::transform(divisor[0], divisor[0] + count, divisor[1], lesser.row(y) + x,
                                [](float a, float b) { return std::min(a, b); });
               });
  Plane<float>& change = responses[0];
  tbb::parallel_for(0, change.height(), [&](int y) {
    std::transform(change.row(y), change.row(y) + change.stride(), responses[1].row(y), change.row(y),
                   std::minus<>());
  });
  tbb::parallel_for(0, powers.height(), [&](int y) { addInterpolatedPowers(change, lesser, y, powers); });
}

/// Row y of the grid of half the step.
void GridMasking::addInterpolatedPowers(const Plane<float>& change, const Plane<float>& elevation, int y,
                                        Plane<float>& powers) const {
  const int apron = grid_.apron;
  Plane<float> rows(change.width(), 2);
  Plane<float> fine(powers.width() + 1, 3);
  const float* above = change.row(y / 2 + apron);
  const float* elevationAbove = elevation.row(y / 2);
  const float* elevationBelow = elevation.row((y + 1) / 2);
  for (int x = 0; x < change.width(); ++x) {
    rows.row(0)[x] = y % 2 == 0 ? above[x] : halfway(above + x, change.stride());
  }
  for (int x = 0; x < elevation.width(); ++x) {
    rows.row(1)[x] = 0.5f * (elevationAbove[x] + elevationBelow[x]);
  }
  const float* changes = rows.row(0) + apron;
  const float* elevations = rows.row(1);
  // Row 2 stays zero: the difference to no response.
  std::fill_n(fine.row(1), fine.stride(), 1.0f);
  for (int x = 0; 2 * x < powers.width(); ++x) {
    fine.row(0)[2 * x] = changes[x];
    fine.row(1)[2 * x] = elevations[x];
    if (2 * x + 1 < powers.width()) {
      fine.row(0)[2 * x + 1] = halfway(changes + x, 1);
      fine.row(1)[2 * x + 1] = 0.5f * (elevations[x] + elevations[x + 1]);
    }
  }
  addDifferences(fine.row(0), fine.row(2), fine.row(1), fine.row(1), powers.row(y), powers.stride());
}

}  // namespace promenade::aqm
