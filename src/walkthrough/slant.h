#pragma once
// Gloss that was seen at another slant. Every reflection but a perfectly diffuse one gets stronger towards
// grazing angles: the view-dependent layer of a street is brighter far ahead than under one's feet, however
// rough it is. Items too rough to count as view dependent are warped all the same, since a blend of an
// earlier and a later keyframe is off by little and the metric has compared the two. Where one side alone
// shows the surface nobody has.

#include "ibr/blend.h"

namespace promenade::walkthrough {

/// The holes of `blended`, and those of its samples that are as good as holes: filled by sources of one side
/// in time alone, which saw the surface so much more or less slanted that a viewer could tell by its gloss.
/// Only samples that `looksTheSame` selects (ItemTrust) are looked at: other items are judged, and traced, by
/// themselves.
[[nodiscard]] Mask holesAndSlantedGloss(const ibr::Blended& blended, const Mask& looksTheSame);

}  // namespace promenade::walkthrough
