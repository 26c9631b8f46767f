#pragma once
// What view-dependent items show may slide over them too far to be warped from keyframe to keyframe, and still
// be warped over fewer frames. So it is traced in the middle of the segment, and judged again in the middle
// of each half, warped from what was traced at the half's ends: items that pass there are warped in the whole
// half, the others are traced there and judged in the quarters, and so on. Nothing warped is ever a source.
// (ibr.md of the papers' method asks once, for the segment; docs/method.md.)

#include <optional>
#include <vector>

#include "src/walkthrough/inbetween.h"
#include "src/walkthrough/item_set.h"
#include "src/walkthrough/judge.h"

namespace promenade::walkthrough {

/// A frame in which view-dependent items were traced.
struct TracedViews {
  int frameIndex = 0;
  const Frame* frame = nullptr;
  /// The samples whose view-dependent layer was made in this frame (Inbetween::madeHere). Null: all, it is a
  /// keyframe.
  const Mask* known = nullptr;
};

/// Two of them, around the frames in between.
struct ViewRange {
  TracedViews first;
  TracedViews last;
};

/// Items that may be warped from the ends of a range to all frames inside.
struct SettledItems {
  ViewRange range;
  ItemSet items;
};

/// What both ends of a range show, as seen from an inbetween.
struct WarpedViews {
  int first = 0;  ///< frame of the range's beginning
  int last = 0;
  ibr::Warped fromFirst;
  ibr::Warped fromLast;
};

/// Samples of `items` that the draft has no hole at.
[[nodiscard]] Mask samplesOf(const ItemSet& items, const Draft& draft);

/// `wanted` selects samples of `draft`.
[[nodiscard]] WarpedViews warpViews(const ViewRange& range, const Draft& draft, const Mask& wanted,
                                    const ibr::WarpSettings& settings);

/// Of `items` (view-dependent), those whose look from both ends a viewer could not tell apart: at most the
/// tolerance of the pixels that both ends fill differ visibly, and there are some. Everything else in the
/// frame is as drafted. Of `matt` items all of the look comes from the ends, of others the view-dependent
/// layer. `velocity` is the image velocity at display resolution.
[[nodiscard]] ItemSet agreeingItems(const Draft& draft, const WarpedViews& views, const ItemSet& items,
                                    const ItemSet& matt, int frameIndex, const VelocityMap& velocity,
                                    const Renderer& renderer, const Settings& settings);

/// Gives samples of `items` that both ends fill their blended look, and marks them as settled.
void layOver(Draft& draft, const WarpedViews& views, const ItemSet& items, const ItemSet& matt,
             int frameIndex);

}  // namespace promenade::walkthrough
