#pragma once
// Items that are view dependent by their material and hardly look it: too rough, too faint or too evenly lit.
// A stone whose texture is smooth in places counts as a mirror in places, and what of such an item one
// keyframe alone fills would be traced in every inbetween.

#include "src/walkthrough/disputed.h"
#include "src/walkthrough/item_set.h"

namespace promenade::walkthrough {

/// The items of `proven` whose view-dependent layer the two keyframes show alike: on 95 of 100 samples that
/// both fill it differs by at most a tenth of all that the sample shows. Nothing is said of items of fewer
/// than 100 such samples. What the keyframes see is seen from the two ends of a segment, so what one of them
/// shows of an inbetween is seen under a smaller change of the view than was compared.
[[nodiscard]] ItemSet steadyAmong(const ItemSet& proven, const WarpedPair& warped);

}  // namespace promenade::walkthrough
