#include "aqm/gaussian.h"

#include <hwy/highway.h>

#include <cassert>
#include <cmath>

#include "aqm/layout.h"

namespace promenade::aqm {

namespace hn = hwy::HWY_NAMESPACE;

GaussianKernel::GaussianKernel(double sigmaPixels) {
  const int radius = static_cast<int>(std::floor(3.0 * sigmaPixels + 0.5));
  std::vector<double> weights(static_cast<std::size_t>(radius) + 1);
  double sum = 0.0;
  for (std::size_t t = 0; t < weights.size(); ++t) {
    const double distance = static_cast<double>(t) / sigmaPixels;
    weights[t] = std::exp(-0.5 * distance * distance);
    sum += (t == 0 ? 1.0 : 2.0) * weights[t];
  }
  for (const double weight : weights) {
    weights_.push_back(static_cast<float>(weight / sum));
  }
}

void GaussianKernel::weightedSum(const float* const* taps, float* out, int count) const {
  const hn::CappedTag<float, 8> tag;
  const std::size_t lanes = hn::Lanes(tag);
  assert(count % kPlaneUnit == 0 && static_cast<std::size_t>(kPlaneUnit) % (4 * lanes) == 0);
  const auto end = static_cast<std::size_t>(count);
  const auto middle = static_cast<std::size_t>(radius());
  // Four independent sums hide the latency of the additions.
  for (std::size_t x = 0; x < end; x += 4 * lanes) {
    const auto centre = hn::Set(tag, weights_[0]);
    const float* at = taps[middle] + x;
    auto sum0 = hn::Mul(centre, hn::LoadU(tag, at));
    auto sum1 = hn::Mul(centre, hn::LoadU(tag, at + lanes));
    auto sum2 = hn::Mul(centre, hn::LoadU(tag, at + 2 * lanes));
    auto sum3 = hn::Mul(centre, hn::LoadU(tag, at + 3 * lanes));
    for (std::size_t t = 1; t <= middle; ++t) {
      const auto weight = hn::Set(tag, weights_[t]);
      const float* before = taps[middle - t] + x;
      const float* after = taps[middle + t] + x;
      const auto pair = [&](std::size_t i) {
        return hn::Add(hn::LoadU(tag, before + i), hn::LoadU(tag, after + i));
      };
      sum0 = hn::MulAdd(weight, pair(0), sum0);
      sum1 = hn::MulAdd(weight, pair(lanes), sum1);
      sum2 = hn::MulAdd(weight, pair(2 * lanes), sum2);
      sum3 = hn::MulAdd(weight, pair(3 * lanes), sum3);
    }
    hn::StoreU(sum0, tag, out + x);
    hn::StoreU(sum1, tag, out + x + lanes);
    hn::StoreU(sum2, tag, out + x + 2 * lanes);
    hn::StoreU(sum3, tag, out + x + 3 * lanes);
  }
}

ExtendedRow::ExtendedRow(int width, int radius, Border border)
    : width_(width),
      radius_(radius),
      offset_(static_cast<std::ptrdiff_t>((radius + kPlaneUnit - 1) / kPlaneUnit) * kPlaneUnit),
      border_(border),
      // Two units more than the samples take, so that the last whole vector of the last tap lies inside.
      buffer_(width + 2 * (radius + kPlaneUnit) + kPlaneUnit, 1) {
  for (int t = -radius; t <= radius; ++t) {
    taps_.push_back(samples() + t);
  }
}

void ExtendedRow::extend() {
  float* row = samples();
  for (int i = 1; i <= radius_; ++i) {
    row[-i] = border_ == Border::kZero ? 0.0f : row[reflected(-i, width_)];
    row[width_ - 1 + i] = border_ == Border::kZero ? 0.0f : row[reflected(width_ - 1 + i, width_)];
  }
}

std::vector<const float*> columnTaps(const Plane<float>& plane, int y, int radius, Border border,
                                     const float* zeroRow) {
  std::vector<const float*> taps;
  taps.reserve(2 * static_cast<std::size_t>(radius) + 1);
  for (int t = y - radius; t <= y + radius; ++t) {
    const bool isOutside = t < 0 || t >= plane.height();
    taps.push_back(isOutside && border == Border::kZero ? zeroRow : plane.row(reflected(t, plane.height())));
  }
  return taps;
}

}  // namespace promenade::aqm
