#include "aqm/fast_bank.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "aqm/fast_filters.h"
#include "aqm/fourier.h"
#include "aqm/gaussian.h"
#include "aqm/grid_masking.h"
#include "aqm/passband.h"
#include "aqm/row_pairs.h"
#include "aqm/transpose.h"

namespace promenade::aqm {
namespace {

/// Of a channel's sensitivity, and of 2 where it is lower. The grids' interpolation costs more.
constexpr double kTolerance = 0.02;

/// Degrees per second; images at up to 100 for an eye that tracks them. (A step of the speeds more than 20.)
constexpr double kFastestOnRetina = 20.5;

bool isCovered(const Settings& settings) {
  return settings.decomposition != Decomposition::kLaplacianPyramid &&
         (settings.csf == Csf::kKellyDaly || settings.csf == Csf::kDalyMoving) &&
         settings.contrast == ContrastKind::kGlobal && settings.masking.elevation != Elevation::kDaly &&
         settings.signedMap == SignedMap::kNo;
}

/// Two cache lines of complex floats: the unit of transposition.
constexpr int kRowsTransposed = 16;
constexpr int kColumnsTransposed = 4;

/// The channels of one band, one after the other.
class FastBand {
 public:
  FastBand(const BandPlan& plan, const Layout& layout, const FilterBank& filters, const Settings& settings,
           const PerFrame<const Spectrum*>& spectra)
      : plan_(plan),
        layout_(layout),
        filters_(filters),
        spectra_(spectra),
        plans_(plan.grid.padded),
        masking_(plan.band, plan.grid, layout.image, settings.masking),
        radial_(radialPlanes(filters, plan.band, plan.terms, layout, plan.grid)) {
    const Size sites = plan.grid.sites;
    const int apron = plan.grid.apron;
    for (std::size_t frame = 0; frame < 2; ++frame) {
      for (std::size_t m = 0; m < radial_.size(); ++m) {
        columns_[frame].emplace_back(plan.grid.padded.height, radial_[m].height());
      }
      responses_[frame] = Plane<float>(sites.width + 2 * apron, sites.height + 2 * apron);
    }
  }

  /// Adds d^3.5 of the channel to `powers` on the grid of half the step. `steps` is null where nothing moves.
  void add(int orientation, const Plane<float>& fan, const Plane<std::uint16_t>* steps,
           Plane<float>& powers) {
    transformColumns(orientation, fan);
    transformRows(steps);
    masking_.addPowers(responses_, powers);
  }

 private:
  struct Scratch {
    Scratch(const BandPlan& plan, const GridMasking& masking, int width)
        : rows(plan.grid.padded.width / 2 + 1, kRowsTransposed),
          packed(plan.grid.padded.width, 1),
          filtered(plan.grid.padded.width + 2 * plan.grid.apron + kPlaneUnit, 1),
          weights(width, static_cast<int>(plan.terms.shapes.size()) * kRowsTransposed),
          spare(width, 1),
          extended(masking.extendedRow()) {
      // Where nothing moves, nothing else is written here.
      for (std::size_t m = 0; m < plan.terms.shapes.size(); ++m) {
        for (int i = 0; i < kRowsTransposed; ++i) {
          std::fill_n(weightsOf(m, i), width, plan.terms.coefficients[m][0]);
        }
      }
    }
    /// Of term m in row i of the block.
    float* weightsOf(std::size_t m, int i) { return weights.row(static_cast<int>(m) * kRowsTransposed + i); }

    Spectrum rows;
    Spectrum packed;  ///< of two rows; stays 0 where the channel passes nothing
    Spectrum filtered;
    Plane<float> weights;
    Plane<float> spare;  ///< the second row of a pair whose first is the last one
    ExtendedRow extended;
  };

  /// Filters each column of the spectra for every term and transforms it. Sets passed_.
  void transformColumns(int orientation, const Plane<float>& fan) {
    const Size padded = plan_.grid.padded;
    std::vector<PassedRows> passed;
    passed_ = {radial_[0].height(), 0};
    for (int ix = 0; ix < radial_[0].height(); ++ix) {
      passed.push_back(passedRows(filters_, plan_.band, orientation, ix, padded, plan_.grid.step));
      if (!passed.back().empty()) {
        passed_ = {std::min(passed_.begin, ix), ix + 1};
      }
    }
    // Rows of negative frequencies sit at the end of a full column.
    const int toFull = layout_.padded.height - padded.height;
    tbb::parallel_for(
        tbb::blocked_range<int>(passed_.begin, std::max(passed_.begin, passed_.end), kColumnsTransposed),
        [&](const tbb::blocked_range<int>& range) {
          Spectrum filtered(padded.height, 2);
          for (int ix = range.begin(); ix != range.end(); ++ix) {
            const PassedRows& rows = passed[static_cast<std::size_t>(ix)];
            for (std::size_t m = 0; m < radial_.size(); ++m) {
              const auto filter = [&](Interval interval, int shift) {
                const float* radial = radial_[m].row(ix);
                const float* angular = fan.row(ix) + shift;
                const std::complex<float>* test = spectra_[0]->row(ix) + shift;
                const std::complex<float>* reference = spectra_[1]->row(ix) + shift;
                for (int iy = interval.begin; iy < interval.end; ++iy) {
                  const float value = radial[iy] * angular[iy];
                  filtered.row(0)[iy] = test[iy] * value;
                  filtered.row(1)[iy] = reference[iy] * value;
                }
              };
              filter(rows.positive, 0);
              filter(rows.negative, toFull);
              for (std::size_t frame = 0; frame < 2; ++frame) {
                plans_.inverseColumn(filtered.row(static_cast<int>(frame)), columns_[frame][m].row(ix));
              }
            }
            for (const Interval interval : {rows.positive, rows.negative}) {
              for (int frame = 0; frame < 2; ++frame) {
                std::fill(filtered.row(frame) + interval.begin,
                          filtered.row(frame) + std::max(interval.begin, interval.end), 0.0f);
              }
            }
          }
        });
  }

  /// Rows and columns of the responses start `apron` sites before the image. Out there, the velocity is that
  /// of the nearest pixel.
  void weigh(const Plane<std::uint16_t>& steps, int begin, int end, Scratch& scratch) const {
    const Grid& grid = plan_.grid;
    const auto pixel = [&](int i, int length) {
      return std::clamp((i - grid.apron) * grid.step, 0, length - 1);
    };
    const int width = grid.sites.width + 2 * grid.apron;
    for (int y = begin; y < end; ++y) {
      const std::uint16_t* row = steps.row(pixel(y, layout_.image.height));
      for (std::size_t m = 0; m < radial_.size(); ++m) {
        const float* table = plan_.terms.coefficients[m].data();
        float* weights = scratch.weightsOf(m, y - begin);
        for (int x = 0; x < grid.apron; ++x) {
          weights[x] = table[row[0]];
        }
        const int inside = (layout_.image.width - 1) / grid.step + 1 + grid.apron;
        for (int x = grid.apron; x < inside; ++x) {
          weights[x] = table[row[(x - grid.apron) * grid.step]];
        }
        for (int x = inside; x < width; ++x) {
          weights[x] = table[row[layout_.image.width - 1]];
        }
      }
    }
  }

  void transformRows(const Plane<std::uint16_t>* steps) {
    const int apron = plan_.grid.apron;
    const int height = responses_[0].height();
    const int blocks = (height + kRowsTransposed - 1) / kRowsTransposed;
    tbb::enumerable_thread_specific<Scratch> scratches(
        [&] { return Scratch(plan_, masking_, responses_[0].width()); });
    tbb::parallel_for(0, blocks, [&](int block) {
      Scratch& scratch = scratches.local();
      const int begin = block * kRowsTransposed;
      const int end = std::min(begin + kRowsTransposed, height);
      if (steps != nullptr) {
        weigh(*steps, begin, end, scratch);
      }
      for (std::size_t frame = 0; frame < 2; ++frame) {
        for (int y = begin; y < end; ++y) {
          std::fill_n(responses_[frame].row(y), responses_[frame].stride(), 0.0f);
        }
        for (std::size_t m = 0; m < radial_.size(); ++m) {
          takeRows(columns_[frame][m], begin, end, scratch.rows);
          addRows(m, begin, end, scratch, responses_[frame]);
        }
        if (masking_.masks(frame)) {
          for (int y = std::max(begin, apron); y < std::min(end, height - apron); ++y) {
            masking_.elevateRow(frame, y - apron, responses_[frame].row(y), scratch.extended);
          }
        }
      }
    });
  }

  /// Rows begin .. end - 1 of the responses, which start `apron` sites before the image, out of the columns;
  /// and a row of nothing if they are an odd number.
  void takeRows(const Spectrum& columns, int begin, int end, Spectrum& rows) const {
    const Grid& grid = plan_.grid;
    const int first = grid.margin - grid.apron + begin;
    const int beforeWrap = std::clamp(grid.padded.height - first, 0, end - begin);
    transposeRows(columns, first, beforeWrap, passed_.begin, passed_.end, rows);
    for (int i = beforeWrap; i < end - begin; ++i) {
      for (int ix = passed_.begin; ix < passed_.end; ++ix) {
        rows.row(i)[ix] = columns.row(ix)[first + i - grid.padded.height];
      }
    }
    if ((end - begin) % 2 != 0) {
      std::fill(rows.row(end - begin) + passed_.begin,
                rows.row(end - begin) + std::max(passed_.begin, passed_.end), 0.0f);
    }
  }

  /// Transforms scratch.rows, two at a time, and adds them, weighted as term m is, to rows begin .. end - 1.
  void addRows(std::size_t m, int begin, int end, Scratch& scratch, Plane<float>& to) const {
    const Grid& grid = plan_.grid;
    const int width = grid.padded.width;
    for (int i = 0; i < end - begin; i += 2) {
      packRows(scratch.rows.row(i), scratch.rows.row(i + 1), passed_.begin, passed_.end, width,
               scratch.packed.row(0));
      std::complex<float>* filtered = scratch.filtered.row(0);
      plans_.inverseRowPair(scratch.packed.row(0), filtered);
      std::copy_n(filtered, 2 * grid.apron, filtered + width);
      float* second = i + 1 < end - begin ? to.row(begin + i + 1) : scratch.spare.row(0);
      addRowPair(filtered + grid.margin - grid.apron, scratch.weightsOf(m, i), scratch.weightsOf(m, i + 1),
                 to.row(begin + i), second, to.stride());
    }
  }

  const BandPlan& plan_;
  const Layout& layout_;
  const FilterBank& filters_;
  const PerFrame<const Spectrum*> spectra_;
  const FourierPlans plans_;
  GridMasking masking_;
  const std::vector<Plane<float>> radial_;  ///< one per term
  Interval passed_;
  PerFrame<std::vector<Spectrum>> columns_;  ///< filtered, transformed along the columns; one per term
  PerFrame<Plane<float>> responses_;
};

}  // namespace

std::optional<SpeedSteps> speedsToRunFast(const VelocityMap& velocity, const Settings& settings) {
  if (settings.execution != Execution::kFast || !isCovered(settings)) return std::nullopt;
  SpeedSteps speeds = speedSteps(velocity, settings.orientations, settings.eye);
  if (speeds.fastest > kFastestOnRetina) return std::nullopt;
  return speeds;
}

std::vector<BandPlan> bandPlans(const Layout& layout, const FilterBank& filters, const Settings& settings,
                                const Adaptation& adaptation, const SpeedSteps& speeds) {
  std::vector<BandPlan> plans;
  for (int band = 1; band <= layout.bands + 1; ++band) {
    plans.push_back({band, gridOf(layout, gridStep(band, layout.bands)),
                     speedTerms(filters, band, settings, adaptation, speeds.levels, speeds.first, speeds.last,
                                kTolerance)});
  }
  return plans;
}

Plane<float> fastPowers(const Layout& layout, const Spectrum& test, const Spectrum& reference,
                        const FilterBank& filters, const Settings& settings, const Adaptation& adaptation,
                        const SpeedSteps& speeds) {
  std::vector<Plane<float>> fans;
  for (int l = 0; filters.orientations() > 1 && l < filters.orientations(); ++l) {
    fans.push_back(fanPlane(filters, l, layout));
  }
  const Plane<float> unoriented = fanPlane(filters, kUnoriented, layout);

  std::vector<Plane<float>> powers;  // on grids of 1, 2, 4 .. pixels
  for (const BandPlan& plan : bandPlans(layout, filters, settings, adaptation, speeds)) {
    if (plan.terms.shapes.empty()) {
      continue;  // blind
    }
    const int step = std::max(1, plan.grid.step / 2);
    const auto level = static_cast<std::size_t>(std::lround(std::log2(step)));
    while (powers.size() <= level) {
      const Size sites = gridOf(layout, 1 << powers.size()).sites;
      powers.emplace_back(sites.width, sites.height);
    }
    FastBand band(plan, layout, filters, settings, {&test, &reference});
    if (plan.band > layout.bands || fans.empty()) {
      band.add(kUnoriented, unoriented, speeds.of(kUnoriented), powers[level]);
      continue;
    }
    for (int l = 0; l < filters.orientations(); ++l) {
      band.add(l, fans[static_cast<std::size_t>(l)], speeds.of(l), powers[level]);
    }
  }
  if (powers.empty()) {
    return Plane<float>(layout.image.width, layout.image.height);
  }
  while (powers.size() > 1) {
    const Plane<float> coarse = std::move(powers.back());
    powers.pop_back();
    addInterpolated(coarse, powers.back());
  }
  return std::move(powers.front());
}

}  // namespace promenade::aqm
