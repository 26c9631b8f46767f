#pragma once
// What may be warped of the items of an inbetween, by the verdict on its segment.

#include "src/core/renderer.h"
#include "src/walkthrough/judge.h"

namespace promenade::walkthrough {

/// Masks at sample resolution, from what is known of each sample's item. What none of them selects may be
/// warped where both keyframes agree on it.
struct ItemTrust {
  Mask looksTheSame;    ///< ItemVerdict::looksTheSame(): one source is enough, and the background
  Mask untrusted;       ///< failing items, and view-dependent ones of which nothing is known
  Mask disputesCount;   ///< ItemVerdict::disputes
  ItemSet tracedWhole;  ///< the untrusted items
};

[[nodiscard]] ItemTrust trustIn(const ItemBuffer& item, const ItemVerdict& verdict, const Renderer& renderer);

}  // namespace promenade::walkthrough
