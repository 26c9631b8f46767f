#pragma once
// Gloss that was seen from elsewhere. What is reflected moves with the eye, on rough surfaces too, if slowly:
// a leather seat gets brighter by a tenth while one walks up to it. Items too rough to count as
// view dependent are warped all the same, and where both keyframes show them the blend is right. How their
// gloss changes there from one keyframe to the other tells what it does beside, where one side alone shows
// the surface.

#include "ibr/blend.h"
#include "src/walkthrough/disputed.h"

namespace promenade::walkthrough {

/// holesAndSlantedGloss(), and those samples filled by sources of one side in time alone whose gloss has
/// changed so much between there and here that a viewer could tell, going by samples of the same item around
/// them that both keyframes fill. Where there are none, nothing is known. Only samples that `looksTheSame`
/// selects (ItemTrust) are looked at. Does not look at the target of `keyframes`, which may have become that
/// of `blended`.
[[nodiscard]] Mask holesAndChangedGloss(const ibr::Blended& blended, const WarpedPair& keyframes,
                                        const Mask& looksTheSame);

}  // namespace promenade::walkthrough
