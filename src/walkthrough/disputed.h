#pragma once
// Where the two keyframes of a segment contradict each other: a reflection or a highlight that is in one of
// them only, or a pattern that is finer than their samples.

#include <cstddef>

#include "ibr/warp.h"
#include "src/core/renderer.h"
#include "src/walkthrough/item_set.h"

namespace promenade::walkthrough {

/// Both keyframes of a segment as seen from one of its inbetweens, at sample resolution.
struct WarpedPair {
  Visibility target;
  ibr::Warped fromFirst;
  ibr::Warped fromLast;
  Mask disputed;  ///< disputedSamples() of the rest

  /// Sample i, row by row.
  [[nodiscard]] bool firstFills(std::size_t i) const {
    return fromFirst.validity.pixels()[i] == ibr::Validity::kValid;
  }
  [[nodiscard]] bool lastFills(std::size_t i) const {
    return fromLast.validity.pixels()[i] == ibr::Validity::kValid;
  }
  [[nodiscard]] bool bothFill(std::size_t i) const { return firstFills(i) && lastFills(i); }
};

/// Samples that both keyframes fill, with luminances that differ by more than a tenth of the larger: no blend
/// of the two is right. An item may have few of them, too few to be seen in the middle of the segment, and
/// elsewhere a glint on a door handle. The background has none. At sample resolution. Does not look at
/// WarpedPair::disputed.
[[nodiscard]] Mask disputedSamples(const WarpedPair& warped);

/// Of which items disputed samples count. Those that look the same from everywhere are disputed where their
/// pattern is finer than the samples: road markings far ahead.
enum class Disputes {
  kOfViewDependentItems,
  kOfAllItems,
};

[[nodiscard]] inline bool countFor(Disputes disputes, const ItemTraits& traits) {
  return disputes == Disputes::kOfAllItems || traits.viewDependent;
}

/// Those of WarpedPair::disputed that count.
[[nodiscard]] Mask disputedOf(const WarpedPair& warped, Disputes disputes, const Renderer& renderer);

/// The items of which more than a tenth of what both keyframes fill is disputed.
[[nodiscard]] ItemSet widelyDisputed(const Mask& disputed, const WarpedPair& warped);

/// Of the disputed samples, those of other items than the `widely` disputed ones. Of these the rest may agree
/// by chance, as the crests of two wave trains do: they are to be judged whole.
[[nodiscard]] Mask disputedHereAndThere(const Mask& disputed, const ItemSet& widely,
                                        const WarpedPair& warped);

}  // namespace promenade::walkthrough
