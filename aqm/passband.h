#pragma once
// Which coefficients of a half spectrum a channel passes at all: a sector of an annulus.

#include "aqm/filter_bank.h"
#include "src/core/image.h"

namespace promenade::aqm {

struct Interval {
  int begin = 0;
  int end = 0;
};

/// Rows of one column of a half spectrum: those of frequencies fy >= 0, and those of fy < 0. May share
/// Nyquist's.
struct PassedRows {
  Interval positive;
  Interval negative;
  [[nodiscard]] bool empty() const {
    return positive.begin >= positive.end && negative.begin >= negative.end;
  }
};

/// Of a spectrum of `padded` = full size / `step` samples, whose frequencies are those of the full one up to
/// 1 / (2 step) cycles per pixel. `orientation` may be kUnoriented. Never too few; a row or two too many.
[[nodiscard]] PassedRows passedRows(const FilterBank& filters, int band, int orientation, int column,
                                    Size padded, int step);

}  // namespace promenade::aqm
