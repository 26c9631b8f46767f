#pragma once
// The pictures on the walls: scenes given as colour fields, put down stroke by stroke.

#include "examples/hall/picture.h"

namespace promenade::hall {

enum class Motif { kMountains, kSea, kBirches, kColorFields, kCircles, kGrid, kStillLife, kPoppies };
inline constexpr int kMotifCount = 8;

/// About `pixels` pixels along the longer edge; `aspect` = width / height.
[[nodiscard]] Picture painting(Motif motif, double aspect, int pixels);

}  // namespace promenade::hall
