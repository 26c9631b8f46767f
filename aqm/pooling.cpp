#include "aqm/pooling.h"

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "aqm/gaussian.h"
#include "aqm/masking_rows.h"

namespace promenade::aqm {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::CappedTag<float, 8>;

constexpr float kExponent = 3.5f;
/// Standard deviation of the pooling window, degrees.
constexpr double kPoolingDegrees = 0.5;

/// function(vector of 8) of every element. Vectors go beyond the map's width in the plane's padding only.
template <class Map, class Function>
Map mapped(const Plane<float>& plane, const Function& function) {
  Map result(plane.width(), plane.height());
  tbb::parallel_for(0, plane.height(), [&](int y) {
    const Lanes tag;
    alignas(64) float values[kPlaneUnit];
    for (int x = 0; x < plane.width(); x += kPlaneUnit) {
      for (int i = 0; i < kPlaneUnit; i += static_cast<int>(hn::Lanes(tag))) {
        hn::Store(function(hn::Load(tag, plane.row(y) + x + i)), tag, values + i);
      }
      std::copy_n(values, std::min(kPlaneUnit, plane.width() - x), result.row(y).data() + x);
    }
  });
  return result;
}

/// power^(1/3.5); 0 of what is too small for a normal number.
template <class V>
V root(V power) {
  const Lanes tag;
  const auto least = hn::Set(tag, 1e-37f);
  const auto result =
      hn::Exp(tag, hn::Mul(hn::Set(tag, 1.0f / kExponent), hn::Log(tag, hn::Max(power, least))));
  return hn::IfThenElseZero(hn::Gt(power, least), result);
}

}  // namespace

JndMap sharpJnd(const Plane<float>& powers) {
  return mapped<JndMap>(powers, [](auto power) { return root(power); });
}

Plane<float> pooledPowers(const Plane<float>& powers, double pixelsPerDegree) {
  const GaussianKernel kernel(kPoolingDegrees * pixelsPerDegree);
  const auto area = static_cast<float>(2.0 * std::numbers::pi * kPoolingDegrees * kPoolingDegrees);
  const int blocks = (powers.height() + kRowsPerBlock - 1) / kRowsPerBlock;

  Plane<float> alongRows(powers.width(), powers.height());
  tbb::parallel_for(0, blocks, [&](int block) {
    ExtendedRow row(powers.width(), kernel.radius(), Border::kZero);
    const int end = std::min((block + 1) * kRowsPerBlock, powers.height());
    for (int y = block * kRowsPerBlock; y < end; ++y) {
      std::copy_n(powers.row(y), powers.width(), row.samples());
      row.extend();
      kernel.weightedSum(row.taps(), alongRows.row(y), alongRows.stride());
    }
  });

  Plane<float> pooled(powers.width(), powers.height());
  const Plane<float> zeroRow(powers.width(), 1);
  tbb::parallel_for(0, blocks, [&](int block) {
    const int end = std::min((block + 1) * kRowsPerBlock, powers.height());
    for (int x = 0; x < pooled.stride(); x += kStripWidth) {
      const int count = std::min(kStripWidth, pooled.stride() - x);
      for (int y = block * kRowsPerBlock; y < end; ++y) {
        auto taps = columnTaps(alongRows, y, kernel.radius(), Border::kZero, zeroRow.row(0));
        for (const float*& tap : taps) {
          tap += x;
        }
        float* to = pooled.row(y) + x;
        kernel.weightedSum(taps.data(), to, count);
        std::transform(to, to + count, to, [area](float value) { return area * value; });
      }
    }
  });
  return pooled;
}

JndMap pooledJnd(const Plane<float>& pooled) {
  return mapped<JndMap>(pooled, [](auto power) { return root(power); });
}

ProbabilityMap detectionProbability(const Plane<float>& pooled) {
  return mapped<ProbabilityMap>(pooled, [](auto power) {
    const Lanes tag;
    // Beyond 80, exp(-x) is nothing beside 1.
    const auto bounded = hn::Min(power, hn::Set(tag, 80.0f));
    return hn::Neg(hn::Expm1(tag, hn::Neg(bounded)));
  });
}

SignedProbabilityMap signedProbability(const ProbabilityMap& probability, const Plane<float>& changes) {
  SignedProbabilityMap result(probability.size());
  for (int y = 0; y < probability.height(); ++y) {
    std::transform(probability.row(y).begin(), probability.row(y).end(), changes.row(y),
                   result.row(y).begin(), [](float p, float change) {
                     return change > 0.0f ? p : change < 0.0f ? -p : 0.0f;
                   });
  }
  return result;
}

}  // namespace promenade::aqm
