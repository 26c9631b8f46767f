#pragma once
// The filters of FilterBank as planes over a half spectrum, computed eight coefficients at a time.

#include <vector>

#include "aqm/filter_bank.h"
#include "aqm/grid.h"
#include "aqm/plane.h"
#include "aqm/speed_terms.h"

namespace promenade::aqm {

/// Amplitudes of one orientation over the half spectrum of the full size, laid out like a Spectrum.
[[nodiscard]] Plane<float> fanPlane(const FilterBank& filters, int orientation, const Layout& layout);

/// The shapes of a band's terms over the half spectrum of `grid`, as many columns as they pass, divided by
/// the number of samples of the full size: the transforms are unscaled.
[[nodiscard]] std::vector<Plane<float>> radialPlanes(const FilterBank& filters, int band,
                                                     const SpeedTerms& terms, const Layout& layout,
                                                     const Grid& grid);

}  // namespace promenade::aqm
