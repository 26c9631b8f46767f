#pragma once
// Items whose warped look a viewer could tell are traced anew, but not in every sample: their diffuse layer
// was warped, and what they reflect mostly changes little from sample to sample.

#include "src/core/renderer.h"
#include "src/walkthrough/item_set.h"

namespace promenade::walkthrough {

struct RetracedItems {
  Frame frame;
  Mask traced;  ///< the samples that were ray traced
};

/// `frame` is a warped inbetween with its holes traced; `items` (its size) selects the samples whose
/// view-dependent layer was warped from where it looked different. Of each square of 2 x 2 pixels one sample
/// is ray traced; the others keep their warped diffuse layer and get the view-dependent one of the traced
/// samples around them on the same surface, unless these differ too much (ibr::interpolateViewLayer). Around
/// those that get none one sample of each pixel is traced, and where these differ too much, too, all are. Of
/// `matt` items, whose diffuse layer may not be warped either, of items that look the same from everywhere,
/// and of those without noise (ItemTraits::noise), whose reflections may be as fine as a sample, all samples
/// are.
[[nodiscard]] RetracedItems retraceItems(Frame frame, const Mask& items, const ItemSet& matt, int supersample,
                                         int frameIndex, const Renderer& renderer);

}  // namespace promenade::walkthrough
