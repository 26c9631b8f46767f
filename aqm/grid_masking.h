#pragma once
// Masking and summation on the grid of a band (grid.h): what DifferenceSum does, in less time.

#include <array>
#include <vector>

#include "aqm/gaussian.h"
#include "aqm/grid.h"
#include "aqm/plane.h"
#include "aqm/settings.h"

namespace promenade::aqm {

/// Of the test and of the reference frame.
template <class T>
using PerFrame = std::array<T, 2>;

class GridMasking {
 public:
  /// Of band 1 .. K + 1 on its grid; `settings.elevation` is not Elevation::kDaly.
  GridMasking(int band, const Grid& grid, Size image, const Masking& settings);

  /// Whether the frame's elevation counts.
  [[nodiscard]] bool masks(std::size_t frame) const;
  /// Room for elevateRow(), for each thread its own.
  [[nodiscard]] ExtendedRow extendedRow() const {
    return {grid_.sites.width, kernel_.radius(), Border::kReflect};
  }
  /// Elevates row y of the sites, low-passed along the row. `responses` starts at site -apron.
  void elevateRow(std::size_t frame, int y, const float* responses, ExtendedRow& extended);

  /// Adds d^3.5 to `powers`, on the grid of half the step (or of single pixels). Every row has been elevated.
  /// `responses` start apron sites before the image, have as many after it, and are used up.
  void addPowers(PerFrame<Plane<float>>& responses, Plane<float>& powers);

 private:
  void extendDown(Plane<float>& elevation) const;
  [[nodiscard]] PerFrame<const float*> divisors(int y, int x, int count, std::vector<const float*>& taps,
                                                Plane<float>& elevations) const;
  template <class Body>
  void forEachStrip(int height, int stride, const Body& body) const;
  void addInterpolatedPowers(const Plane<float>& change, const Plane<float>& elevation, int y,
                             Plane<float>& powers) const;

  const Grid grid_;
  const Masking settings_;
  const GaussianKernel kernel_;
  const Reflections across_;
  const Reflections down_;
  PerFrame<Plane<float>> elevations_;  ///< low-passed along the rows only
};

}  // namespace promenade::aqm
