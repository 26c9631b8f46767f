#pragma once
// The exposure of frames that are already rendered.

#include <span>

#include "src/io/sequence.h"

namespace promenade::app {

/// One exposure for all sequences: their log-average luminance, of a few frames spread over each, becomes
/// middle grey (Reinhard et al. 2002, eq. 1 and 2), rounded to a tenth of a stop. The order of the sequences
/// changes nothing. Display-encoded frames do not count; 0 if there are no others.
[[nodiscard]] double exposureFor(std::span<const io::Sequence> sequences);

}  // namespace promenade::app
