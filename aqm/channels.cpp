#include "aqm/channels.h"

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "aqm/cortex.h"
#include "aqm/csf.h"

// S(rho_k, v) / S(rho_k, u) * S(rho, u) is computed as three factors that all fit into a float, although the
// quotient alone may not (S spans hundreds of decades where fast motion meets high frequencies): with
// decay(v) of csf.h and rho0 the lowest frequency that the band passes,
//   rho^2 exp(-decay(u) (rho - rho0))                                  a filter, per level
//   exp(-rho_k (decay(v) - decay(u)) - rho0 decay(u)) speedGain(v)     per pixel
// speedGain(u) cancels.

namespace promenade::aqm {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, 8>;

/// One cache line of complex floats: the unit of transposition.
constexpr int kRowsPerLine = 8;
constexpr int kColumnsPerLine = 4;
/// Filter values below this could only make the transforms slow (denormal numbers), never a visible
/// difference.
constexpr float kNegligible = 1e-24f;
/// Exponents stop here. Only the baseband gets there, at retinal speeds above 256 degrees per second.
constexpr float kLargestExponent = 40.0f;

template <class Body>
void forEachColumn(int begin, int end, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<int>(begin, end, kColumnsPerLine),
                    [&](const tbb::blocked_range<int>& range) {
                      for (int ix = range.begin(); ix != range.end(); ++ix) {
                        body(ix);
                      }
                    });
}

/// values[i] = passed[i] exp(-decay (frequency[i] - lowest)), i < count, a multiple of kPlaneUnit.
void shapeByCsf(const float* passed, const float* frequency, double decay, double lowest, float* values,
                int count) {
  const Lanes tag;
  const auto slope = hn::Set(tag, static_cast<float>(-decay));
  const auto offset = hn::Set(tag, static_cast<float>(lowest));
  const auto negligible = hn::Set(tag, kNegligible);
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(tag))) {
    const auto exponent = hn::Mul(slope, hn::Sub(hn::Load(tag, frequency + i), offset));
    // Below the band the exponent is positive and may be large, but there `passed` is 0.
    const auto bounded = hn::Min(exponent, hn::Set(tag, kLargestExponent));
    const auto value = hn::Mul(hn::Load(tag, passed + i), hn::Exp(tag, bounded));
    hn::Store(hn::IfThenElseZero(hn::Gt(value, negligible), value), tag, values + i);
  }
}

/// to[i] = from[i] * values[i].
void multiply(const std::complex<float>* from, const float* values, std::complex<float>* to, int count) {
  for (int i = 0; i < count; ++i) {
    to[i] = from[i] * values[i];
  }
}

/// to[x] += weights[x] * from[x]; `from` need not be aligned.
void addWeighted(const float* weights, const float* from, float* to, int count) {
  for (int x = 0; x < count; ++x) {
    to[x] += weights[x] * from[x];
  }
}

}  // namespace

ChannelBank::ChannelBank(const Layout& layout, const FourierPlans& plans, const Spectrum& test,
                         const Spectrum& reference, const ChannelModel& model)
    : layout_(layout),
      plans_(plans),
      testSpectrum_(test),
      referenceSpectrum_(reference),
      model_(model),
      frequency_(layout.padded.height, layout.spectrumColumns()),
      fan_(layout.padded.height, layout.spectrumColumns()),
      passed_(layout.padded.height, layout.spectrumColumns()),
      testColumns_(layout.padded.height, layout.spectrumColumns()),
      referenceColumns_(layout.padded.height, layout.spectrumColumns()),
      responses_{Plane<float>(layout.image.width, layout.image.height),
                 Plane<float>(layout.image.width, layout.image.height)} {
  const Size padded = layout.padded;
  const int columns = layout.spectrumColumns();
  for (int band = 1; band <= layout.bands + 1; ++band) {
    const double passed = std::ceil(model.filters.highest(band) * padded.width) + 1.0;
    radial_.emplace_back(padded.height, static_cast<int>(std::min<double>(columns, passed)));
  }
  forEachColumn(0, columns, [&](int ix) {
    for (int iy = 0; iy < padded.height; ++iy) {
      const Frequency f{signedFrequency(ix, padded.width), signedFrequency(iy, padded.height)};
      frequency_.row(ix)[iy] = static_cast<float>(std::hypot(f.x, f.y) * layout.pixelsPerDegree);
      for (int band = 1; band <= layout.bands + 1; ++band) {
        Plane<float>& amplitudes = radial_[static_cast<std::size_t>(band - 1)];
        if (ix < amplitudes.height()) {
          amplitudes.row(ix)[iy] = static_cast<float>(model.filters.radial(f, band));
        }
      }
    }
  });
}

void ChannelBank::relateTo(Plane<float> testMeans, Plane<float> referenceMeans) {
  means_ = {std::move(testMeans), std::move(referenceMeans)};
}

ChannelBank::Columns ChannelBank::passColumns(const Channel& channel) {
  const Size padded = layout_.padded;
  if (channel.orientation != fanOrientation_) {
    fanOrientation_ = channel.orientation;
    forEachColumn(0, layout_.spectrumColumns(), [&](int ix) {
      for (int iy = 0; iy < padded.height; ++iy) {
        const Frequency frequency{signedFrequency(ix, padded.width), signedFrequency(iy, padded.height),
                                  2 * ix == padded.width, 2 * iy == padded.height};
        fan_.row(ix)[iy] = static_cast<float>(model_.filters.fan(frequency, channel.orientation));
      }
    });
  }
  const Plane<float>& radial = radial_[static_cast<std::size_t>(channel.band - 1)];
  // The transforms are unscaled.
  const auto scale = static_cast<float>(model_.gain / static_cast<double>(padded.area()));
  const bool byLevels = isByLevels();
  std::vector<char> passes(static_cast<std::size_t>(radial.height()));
  forEachColumn(0, radial.height(), [&](int ix) {
    bool any = false;
    for (int iy = 0; iy < padded.height; ++iy) {
      float value = scale * radial.row(ix)[iy] * fan_.row(ix)[iy];
      if (byLevels) {
        const float rho = frequency_.row(ix)[iy];
        value *= rho * rho;
        if (model_.csf == Csf::kDalyMoving && value != 0.0f) {
          value *= static_cast<float>(stillFactor(static_cast<double>(rho), model_.adaptation));
        }
      } else if (value != 0.0f) {
        const double s = spectralSensitivity(signedFrequency(ix, padded.width),
                                             signedFrequency(iy, padded.height), channel);
        value *= static_cast<float>(s);
      }
      passed_.row(ix)[iy] = value;
      any = any || value != 0.0f;
    }
    passes[static_cast<std::size_t>(ix)] = any ? 1 : 0;
  });
  const auto first = std::find(passes.begin(), passes.end(), 1);
  const auto last = std::find(passes.rbegin(), passes.rend(), 1);
  return first == passes.end()
             ? Columns{}
             : Columns{static_cast<int>(first - passes.begin()), static_cast<int>(passes.rend() - last)};
}

bool ChannelBank::isByLevels() const {
  return (model_.csf == Csf::kKellyDaly || model_.csf == Csf::kDalyMoving) &&
         model_.placement == CsfPlacement::kWithinBands;
}

double ChannelBank::spectralSensitivity(double fx, double fy, const Channel& channel) const {
  const double ppd = layout_.pixelsPerDegree;
  const bool isCentre = model_.placement == CsfPlacement::kBandCentres;
  const double rho = ppd * (isCentre ? model_.filters.centre(channel.band) : std::hypot(fx, fy));
  switch (model_.csf) {
    case Csf::kKellyDaly:
      return 1.0;  // with the pixels, because it depends on the speed
    case Csf::kDalyMoving:
      return stillFactor(rho, model_.adaptation);  // the rest with the pixels
    case Csf::kDaly: {
      const double angle =
          !isCentre ? std::atan2(fy, fx)
                    : (channel.orientation == kUnoriented
                           ? 0.0
                           : std::numbers::pi * channel.orientation / model_.filters.orientations());
      return dalySensitivity(rho, angle, model_.adaptation);
    }
    case Csf::kMannosSakrison:
      return mannosSakrisonSensitivity(rho);
  }
  return 0.0;
}

void ChannelBank::filterColumns(Columns columns, double decay, double lowest) {
  const int height = layout_.padded.height;
  tbb::parallel_for(tbb::blocked_range<int>(columns.begin, columns.end, kColumnsPerLine),
                    [&](const tbb::blocked_range<int>& range) {
                      Plane<float> values(height, 1);
                      Spectrum filtered(height, 1);
                      for (int ix = range.begin(); ix != range.end(); ++ix) {
                        shapeByCsf(passed_.row(ix), frequency_.row(ix), decay, lowest, values.row(0),
                                   values.stride());
                        multiply(testSpectrum_.row(ix), values.row(0), filtered.row(0), height);
                        plans_.inverseColumn(filtered.row(0), testColumns_.row(ix));
                        multiply(referenceSpectrum_.row(ix), values.row(0), filtered.row(0), height);
                        plans_.inverseColumn(filtered.row(0), referenceColumns_.row(ix));
                      }
                    });
}

template <class Needed, class Weights>
void ChannelBank::addRows(Columns columns, const Needed& needed, const Weights& weigh) {
  const int spectrumColumns = layout_.spectrumColumns();
  const int stride = responses_.test.stride();
  const int blocks = (layout_.image.height + kRowsPerLine - 1) / kRowsPerLine;
  tbb::parallel_for(0, blocks, [&](int block) {
    const int begin = block * kRowsPerLine;
    const int end = std::min(begin + kRowsPerLine, layout_.image.height);
    bool any = false;
    for (int y = begin; y < end; ++y) {
      any = any || needed(y);
    }
    if (!any) {
      return;
    }
    Plane<float> weights(layout_.image.width, kRowsPerLine);
    for (int y = begin; y < end; ++y) {
      weigh(y, weights.row(y - begin));
    }
    // Also holds what lies right of the padded image when whole vectors are read from the margin on.
    Plane<float> filtered(std::max(layout_.padded.width, layout_.margin + stride), 1);
    Spectrum rows(spectrumColumns, kRowsPerLine);
    for (auto [from, to] :
         {std::pair(&testColumns_, &responses_.test), std::pair(&referenceColumns_, &responses_.reference)}) {
      for (int i = 0; i < end - begin; ++i) {
        // The last transform has overwritten the row.
        std::fill(rows.row(i), rows.row(i) + columns.begin, 0.0f);
        std::fill(rows.row(i) + columns.end, rows.row(i) + spectrumColumns, 0.0f);
      }
      for (int ix = columns.begin; ix < columns.end; ++ix) {
        const std::complex<float>* column = from->row(ix) + layout_.margin + begin;
        for (int i = 0; i < end - begin; ++i) {
          rows.row(i)[ix] = column[i];
        }
      }
      for (int y = begin; y < end; ++y) {
        if (needed(y)) {
          plans_.inverseRow(rows.row(y - begin), filtered.row(0));
          addWeighted(weights.row(y - begin), filtered.row(0) + layout_.margin, to->row(y), stride);
        }
      }
    }
  });
}

void ChannelBank::respondByLevels(Columns columns, const Channel& channel, const SpeedField& speeds) {
  const double ppd = layout_.pixelsPerDegree;
  const double centre = ppd * model_.filters.centre(channel.band);
  const double lowest = ppd * model_.filters.lowest(channel.band);
  const double decayPerSpeed = frequencyDecay(1.0) - frequencyDecay(0.0);
  const Lanes tag;
  for (int level = 0; level <= speeds.steps.last; ++level) {
    if ((speeds.levels >> level & 1u) == 0) {
      continue;
    }
    const double levelSpeed = speeds.steps.speed(level);
    const auto levelOctave = hn::Set(tag, static_cast<float>(level));
    const auto levelValue = hn::Set(tag, static_cast<float>(levelSpeed));
    const auto slope = hn::Set(tag, static_cast<float>(-centre * decayPerSpeed));
    const auto offset = hn::Set(tag, static_cast<float>(-lowest * frequencyDecay(levelSpeed)));
    const auto one = hn::Set(tag, 1.0f);
    filterColumns(columns, frequencyDecay(levelSpeed), lowest);
    addRows(
        columns, [&](int y) { return (speeds.levelsOfRow[static_cast<std::size_t>(y)] >> level & 1u) != 0; },
        [&](int y, float* weights) {
          for (int x = 0; x < speeds.speed.stride(); x += static_cast<int>(hn::Lanes(tag))) {
            const auto distance = hn::Abs(hn::Sub(hn::Load(tag, speeds.octave.row(y) + x), levelOctave));
            const auto hat = hn::Max(hn::Zero(tag), hn::Sub(one, distance));
            const auto faster = hn::Sub(hn::Load(tag, speeds.speed.row(y) + x), levelValue);
            const auto exponent = hn::Add(hn::Mul(slope, faster), offset);
            const auto ratio = hn::Exp(tag, hn::Min(exponent, hn::Set(tag, kLargestExponent)));
            hn::Store(hn::Mul(hn::Mul(hat, hn::Load(tag, speeds.gain.row(y) + x)), ratio), tag, weights + x);
          }
        });
  }
}

void ChannelBank::respondAtCentre(Columns columns, const Channel& channel, const SpeedField& speeds) {
  const double centre = layout_.pixelsPerDegree * model_.filters.centre(channel.band);
  const double decayPerSpeed = frequencyDecay(1.0) - frequencyDecay(0.0);
  const Lanes tag;
  const auto square = hn::Set(tag, static_cast<float>(centre * centre));
  const auto slope = hn::Set(tag, static_cast<float>(-centre * decayPerSpeed));
  const auto offset = hn::Set(tag, static_cast<float>(-centre * frequencyDecay(0.0)));
  const bool followsSpeed = model_.csf == Csf::kKellyDaly || model_.csf == Csf::kDalyMoving;
  filterColumns(columns, 0.0, 0.0);
  addRows(
      columns, [](int) { return true; },
      [&](int y, float* weights) {
        if (!followsSpeed) {
          std::fill_n(weights, layout_.image.width, 1.0f);
          return;
        }
        for (int x = 0; x < speeds.speed.stride(); x += static_cast<int>(hn::Lanes(tag))) {
          const auto exponent = hn::Add(hn::Mul(slope, hn::Load(tag, speeds.speed.row(y) + x)), offset);
          const auto gain = hn::Mul(square, hn::Load(tag, speeds.gain.row(y) + x));
          hn::Store(hn::Mul(gain, hn::Exp(tag, exponent)), tag, weights + x);
        }
      });
}

const Responses& ChannelBank::respond(const Channel& channel, const SpeedField& speeds) {
  tbb::parallel_for(0, layout_.image.height, [&](int y) {
    std::fill_n(responses_.test.row(y), responses_.test.stride(), 0.0f);
    std::fill_n(responses_.reference.row(y), responses_.reference.stride(), 0.0f);
  });
  const Columns columns = passColumns(channel);
  if (columns.begin < columns.end) {
    if (isByLevels()) {
      respondByLevels(columns, channel, speeds);
    } else {
      respondAtCentre(columns, channel, speeds);
    }
  }
  if (means_.test.width() != 0) {
    tbb::parallel_for(0, layout_.image.height, [&](int y) {
      for (auto [response, mean] :
           {std::pair(&responses_.test, &means_.test), std::pair(&responses_.reference, &means_.reference)}) {
        std::transform(response->row(y), response->row(y) + layout_.image.width, mean->row(y),
                       response->row(y), std::divides<>());
      }
    });
  }
  return responses_;
}

}  // namespace promenade::aqm
