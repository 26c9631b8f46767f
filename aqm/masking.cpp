#include "aqm/masking.h"

#include <hwy/highway.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "aqm/gaussian.h"
#include "aqm/masking_rows.h"

namespace promenade::aqm {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::CappedTag<float, 8>;

/// Larger responses count as this, so that their powers stay finite.
constexpr float kLargestResponse = 1e8f;

template <class V>
V bounded(V response) {
  const Lanes tag;
  return hn::Clamp(response, hn::Set(tag, -kLargestResponse), hn::Set(tag, kLargestResponse));
}

/// Daly 1993: W = 6 and Q = 0.7 in k1 = W^(1 - 1/(1-Q)), k2 = W^(1/(1-Q)).
constexpr double kDalyK1 = 0.0153;
constexpr double kDalyK2 = 392.5;

void addChanges(const float* test, const float* reference, float* sums, int count) {
  for (int x = 0; x < count; ++x) {
    sums[x] += test[x] - reference[x];
  }
}

}  // namespace

void elevateByUnitKnee(const float* responses, double strength, float* elevations, int count) {
  const Lanes tag;
  const auto scale = hn::Set(tag, static_cast<float>(strength));
  for (int x = 0; x < count; x += static_cast<int>(hn::Lanes(tag))) {
    const auto response = bounded(hn::Mul(scale, hn::LoadU(tag, responses + x)));
    const auto square = hn::Mul(response, response);
    const auto fourth = hn::Mul(square, square);
    hn::StoreU(hn::Sqrt(hn::Sqrt(hn::Add(hn::Set(tag, 1.0f), fourth))), tag, elevations + x);
  }
}

void addDifferences(const float* test, const float* reference, const float* testElevation,
                    const float* referenceElevation, float* sums, int count) {
  const Lanes tag;
  for (int x = 0; x < count; x += static_cast<int>(hn::Lanes(tag))) {
    const auto elevation = hn::Min(hn::Load(tag, testElevation + x), hn::Load(tag, referenceElevation + x));
    const auto change =
        hn::Abs(hn::Sub(bounded(hn::Load(tag, test + x)), bounded(hn::Load(tag, reference + x))));
    const auto difference = hn::Div(change, elevation);
    const auto cube = hn::Mul(hn::Mul(difference, difference), difference);
    const auto power = hn::Mul(cube, hn::Sqrt(difference));
    hn::Store(hn::Add(hn::Load(tag, sums + x), power), tag, sums + x);
  }
}

double dalySlope(int band, int bands) {
  return band > bands ? 0.7 : (band == bands ? 0.8 : 1.0);
}

double thresholdElevation(double response, Elevation elevation, double slope) {
  switch (elevation) {
    case Elevation::kNone:
      return 1.0;
    case Elevation::kUnitKnee:
      return std::pow(1.0 + std::pow(response, 4.0), 0.25);
    case Elevation::kDaly:
      return std::pow(1.0 + std::pow(kDalyK1 * std::pow(kDalyK2 * std::abs(response), slope), 4.0), 0.25);
  }
  return 1.0;
}

DifferenceSum::DifferenceSum(Size image, int bands, const Masking& masking, SignedMap signedMap)
    : image_(image),
      bands_(bands),
      masking_(masking),
      powers_(image.width, image.height),
      testElevation_(image.width, image.height),
      referenceElevation_(image.width, image.height) {
  if (signedMap == SignedMap::kYes) {
    changes_ = Plane<float>(image.width, image.height);
  }
}

void DifferenceSum::elevate(const float* responses, double slope, float* elevations, int count) const {
  if (masking_.elevation == Elevation::kUnitKnee) {
    elevateByUnitKnee(responses, masking_.strength, elevations, count);
    return;
  }
  for (int x = 0; x < count; ++x) {
    const double response = masking_.strength * static_cast<double>(std::clamp(
                                                    responses[x], -kLargestResponse, kLargestResponse));
    elevations[x] = static_cast<float>(thresholdElevation(response, masking_.elevation, slope));
  }
}

void DifferenceSum::filterRows(const Plane<float>& responses, double slope, const GaussianKernel& kernel,
                               Plane<float>& to) const {
  const int blocks = (image_.height + kRowsPerBlock - 1) / kRowsPerBlock;
  tbb::parallel_for(0, blocks, [&](int block) {
    ExtendedRow elevation(image_.width, kernel.radius(), Border::kReflect);
    const int end = std::min((block + 1) * kRowsPerBlock, image_.height);
    for (int y = block * kRowsPerBlock; y < end; ++y) {
      elevate(responses.row(y), slope, elevation.samples(), responses.stride());
      elevation.extend();
      kernel.weightedSum(elevation.taps(), to.row(y), to.stride());
    }
  });
}

void DifferenceSum::add(const Responses& responses, int band) {
  // A kernel this narrow is a single weight of 1.
  constexpr double kPointSigma = 0.01;
  const GaussianKernel kernel(masking_.extent == MaskExtent::kChannel ? 0.375 * std::ldexp(1.0, band)
                                                                      : kPointSigma);
  const double slope = dalySlope(band, bands_);
  const bool testMasks = masking_.source != MaskSource::kReference;
  const bool referenceMasks = masking_.source != MaskSource::kTest;
  if (testMasks) {
    filterRows(responses.test, slope, kernel, testElevation_);
  }
  if (referenceMasks) {
    filterRows(responses.reference, slope, kernel, referenceElevation_);
  }

  const int blocks = (image_.height + kRowsPerBlock - 1) / kRowsPerBlock;
  tbb::parallel_for(0, blocks, [&](int block) {
    Plane<float> elevations(kStripWidth, 2);
    const auto lowPass = [&](const Plane<float>& rows, int y, int x, int count, float* to) {
      std::vector<const float*> taps = columnTaps(rows, y, kernel.radius(), Border::kReflect, nullptr);
      for (const float*& tap : taps) {
        tap += x;
      }
      kernel.weightedSum(taps.data(), to, count);
    };
    const int end = std::min((block + 1) * kRowsPerBlock, image_.height);
    for (int x = 0; x < powers_.stride(); x += kStripWidth) {
      const int count = std::min(kStripWidth, powers_.stride() - x);
      for (int y = block * kRowsPerBlock; y < end; ++y) {
        lowPass(testMasks ? testElevation_ : referenceElevation_, y, x, count, elevations.row(0));
        lowPass(referenceMasks ? referenceElevation_ : testElevation_, y, x, count, elevations.row(1));
        addDifferences(responses.test.row(y) + x, responses.reference.row(y) + x, elevations.row(0),
                       elevations.row(1), powers_.row(y) + x, count);
        if (changes_.width() != 0) {
          addChanges(responses.test.row(y) + x, responses.reference.row(y) + x, changes_.row(y) + x, count);
        }
      }
    }
  });
}

}  // namespace promenade::aqm
