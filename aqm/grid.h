#pragma once
// Grids of every D-th pixel, D = 1, 2, 4 .. A band that passes nothing above 1/3 cycle per D pixels is
// transformed back and masked on such a grid (cropping the spectrum is exact at its sites). Its response is
// then interpolated to a grid of D/2: the powers of a response need twice its samples.

#include <cstddef>
#include <vector>

#include "aqm/layout.h"
#include "aqm/plane.h"

namespace promenade::aqm {

/// Sites at pixels (D i, D j); where D > 1, with one site beyond the image on the right and at the bottom, so
/// that every pixel lies between sites.
/// Site i of a row is at pixel D i and at sample margin + i of the transform, which wraps around.
struct Grid {
  int step = 1;
  Size sites;      ///< where D > 1, one more than lie in the image, so that every pixel lies between two
  Size padded;     ///< of the transform
  int margin = 0;  ///< sites before the image in the transform
  int apron = 0;   ///< sites that interpolation needs around the others: 2 where D > 1
};

/// Of band 1 .. K + 1: D = 2^(k - 3), at least 1; 2^(K - 2) of the baseband.
[[nodiscard]] int gridStep(int band, int bands);
[[nodiscard]] Grid gridOf(const Layout& layout, int step);

/// What half-sample reflection at the image's border puts at a site: it falls between two.
struct Reflection {
  int site = 0;
  float weight = 0.0f;  ///< of the next site; 1 - weight of this one
};

/// Of `count` sites before site 0 (the first of them is site -count) and from site `sites` on.
struct Reflections {
  std::vector<Reflection> before;
  std::vector<Reflection> after;
};
[[nodiscard]] Reflections reflectionsOf(int pixels, int sites, int step, int count);

/// Of a signal that has nothing above 1/3 cycle per sample, half-way between `at` and the next sample: three
/// samples on either side count, with weights that are best for a response whose band ends there (error below
/// 1 % of the response at any frequency). `stride` is the distance between samples.
[[nodiscard]] inline float halfway(const float* at, std::ptrdiff_t stride) {
  return 0.60649f * (at[0] + at[stride]) - 0.13414f * (at[-stride] + at[2 * stride]) +
         0.02990f * (at[-2 * stride] + at[3 * stride]);
}

/// fine(i, j) += coarse(i / 2, j / 2), bilinear. `coarse` has half as many sites, rounded up, and one more.
void addInterpolated(const Plane<float>& coarse, Plane<float>& fine);

}  // namespace promenade::aqm
