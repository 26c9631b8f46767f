#pragma once
// Would a viewer see that the middle of a segment was warped? Both keyframes are warped to it and compared.
// Source: Myszkowski, Rokita, Tawara 2000, section 4; masking of pixels that are traced anyway:
// docs/method.md.

#include <vector>

#include "aqm/metric.h"
#include "src/core/renderer.h"
#include "src/walkthrough/disputed.h"
#include "src/walkthrough/item_set.h"
#include "src/walkthrough/walkthrough.h"

namespace promenade::walkthrough {

/// The two images that the metric is given. Where nothing can be compared they are equal.
struct ComparedPair {
  RadianceMap fromFirst;  ///< samples
  RadianceMap fromLast;   ///< samples
  Mask excluded;          ///< samples that will be traced: holes, disputed ones, and `traced` items
  Mask unverified;        ///< samples that only one keyframe fills
};

/// Holes, samples that one keyframe alone fills, samples of `traced` items, and those that `disputed` (sample
/// resolution) selects carry the same value in both images.
[[nodiscard]] ComparedPair comparedPair(const WarpedPair& warped, const ItemSet& traced,
                                        const Mask& disputed);

/// The same with the view-dependent layer of one keyframe in both images for samples of `items` that both
/// fill: what is left to differ there is the diffuse layer.
[[nodiscard]] ComparedPair diffuseCompared(ComparedPair pair, const WarpedPair& warped, const ItemSet& items);

/// A display pixel is selected if more than half of its samples are.
[[nodiscard]] Mask resolveMask(const Mask& samples, int factor);

/// The view-dependent items whose look may not be warped in this segment follow from what was seen in its
/// middle.
struct ItemVerdict {
  /// Compared, and more than the tolerance of their pixels differ visibly; with Disputes::kOfAllItems also
  /// those that look the same from everywhere and are widely disputed.
  ItemSet failing;
  ItemSet proven;       ///< compared on enough pixels, and did not fail
  ItemSet steady = {};  ///< of the proven: hardly changes with the view (steady_items.h)
  ItemSet matt = {};    ///< of the failing: so does their diffuse layer by itself
  /// Which disputed samples are traced throughout the segment.
  Disputes disputes = Disputes::kOfViewDependentItems;

  /// May what one source shows of it be shown from another place? `traits` are the item's.
  [[nodiscard]] bool looksTheSame(ItemId item, const ItemTraits& traits) const {
    return !traits.viewDependent || steady.contains(item);
  }
};

/// `item`, `excluded`, `unverified` at display resolution. Only items for which `renderer` says viewDependent
/// are listed; of those with few pixels (25) that both keyframes fill nothing is known unless they fail.
[[nodiscard]] ItemVerdict judgeItems(const ProbabilityMap& probability, const ItemBuffer& item,
                                     const Mask& excluded, const Mask& unverified, const Renderer& renderer,
                                     double tolerancePercent);

struct Judgement {
  SegmentStatistics statistics;
  ItemVerdict items;
  JudgedMiddle middle;
};

/// `velocity` is the image velocity of the middle frame at display resolution. A segment that would be split,
/// though at most half of the picture differs visibly, is judged again with the disputed samples of all items
/// taken out, and is accepted so if to trace them in all inbetweens costs less than the keyframe that a split
/// would add.
[[nodiscard]] Judgement judgeMiddle(const Segment& segment, const WarpedPair& warped,
                                    const VelocityMap& velocity, const Renderer& renderer,
                                    const Settings& settings);

}  // namespace promenade::walkthrough
