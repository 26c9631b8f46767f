#pragma once
// The view-dependent layer of a surface where it is known at some of its samples: what a surface that is not
// a mirror reflects changes more slowly over it than its texture.

#include <functional>

#include "ibr/crease.h"
#include "src/core/frame.h"

namespace promenade::ibr {

struct ViewLayerSettings {
  int reach = 2;  ///< known samples are looked for so many samples away along x and y, >= 1
  /// Where the luminances known around range over more than this share of the mean luminance there (both
  /// layers), they do not tell what lies between them. > 0.
  /// What is missed is at most about half of that: a crest between them.
  double largestRange = 0.08;
  /// Standard deviation of a known sample's noise, as a share of its luminance (both layers), of an item;
  /// empty: 0 everywhere. Noise is not structure: the range may be wider by what so many samples differ by
  /// chance, and what is fitted to them is cleaner than any of them.
  std::function<float(ItemId)> noise = {};
  double creaseDegrees = kCreaseDegrees;
};

struct ViewLayer {
  RadianceMap viewDependent;  ///< where `found`, else 0
  Mask found;                 ///< the wanted samples that the known ones around could answer
};

/// The view-dependent radiance at the samples that `wanted` selects, from those around that `known` selects
/// and that lie on the same smooth surface (as warping understands it): a plane fitted to them, clamped to
/// their range. Not found where fewer than three are known, or where they differ too much. Both masks have
/// the frame's size. Radiance of samples that are not known is not looked at.
[[nodiscard]] ViewLayer interpolateViewLayer(const Frame& frame, const Mask& known, const Mask& wanted,
                                             const ViewLayerSettings& settings);

}  // namespace promenade::ibr
