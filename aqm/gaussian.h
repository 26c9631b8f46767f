#pragma once
// Separable Gaussian low-pass filters. Pooling and masking differ in what they assume beyond the border of
// the image.

#include <cstddef>
#include <vector>

#include "aqm/plane.h"

namespace promenade::aqm {

/// A normalised Gaussian, symmetric and truncated at `radius()` = int(3 sigma + 0.5).
class GaussianKernel {
 public:
  explicit GaussianKernel(double sigmaPixels);

  [[nodiscard]] int radius() const { return static_cast<int>(weights_.size()) - 1; }
  /// weights()[t] belongs to the samples at distance t; weights()[0] + 2 (weights()[1] + ..) = 1.
  [[nodiscard]] const std::vector<float>& weights() const { return weights_; }

  /// out[x] = sum_t weight[|t|] taps[radius + t][x], t = -radius .. radius, for x < count. Filters a row if
  /// tap t is the row shifted by t, and a column if it is the row t further down. `count` is a multiple of
  /// kPlaneUnit; the same order of summation at every x.
  void weightedSum(const float* const* taps, float* out, int count) const;

 private:
  std::vector<float> weights_;
};

/// What lies beyond the border of the image.
enum class Border {
  kReflect,  ///< the image, mirrored (half-sample symmetric)
  kZero      ///< nothing
};

/// A row with room for `radius` samples on either side, and the pointers that shift it.
class ExtendedRow {
 public:
  ExtendedRow(int width, int radius, Border border);

  /// The row itself: rounded up to whole units of kPlaneUnit elements. Write it, then call extend().
  float* samples() { return buffer_.row(0) + offset_; }
  /// Fills in what lies beyond the border.
  void extend();
  /// For GaussianKernel::weightedSum along the row.
  [[nodiscard]] const float* const* taps() const { return taps_.data(); }

 private:
  int width_ = 0;
  int radius_ = 0;
  std::ptrdiff_t offset_ = 0;  ///< of the row in the buffer, whole units, so that it is aligned
  Border border_ = Border::kReflect;
  Plane<float> buffer_;
  std::vector<const float*> taps_;
};

/// The 2 radius + 1 rows of `plane` around row y, for GaussianKernel::weightedSum down the columns.
[[nodiscard]] std::vector<const float*> columnTaps(const Plane<float>& plane, int y, int radius,
                                                   Border border, const float* zeroRow);

}  // namespace promenade::aqm
