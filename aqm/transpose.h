#pragma once
// From columns of a spectrum to its rows.

#include <complex>

#include "aqm/spectrum.h"

namespace promenade::aqm {

/// to.row(i)[ix] = from.row(ix)[first + i] for begin <= ix < end, i < count <= to.height(). `from` has at
/// least first + count elements in a column.
void transposeRows(const Spectrum& from, int first, int count, int begin, int end, Spectrum& to);

}  // namespace promenade::aqm
