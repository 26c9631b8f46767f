#pragma once
// Frames that something else renders, in the place of a renderer. Visibility is not traced but warped forward
// from them, and what they do not show stays unknown.

#include <functional>

#include "ibr/warp.h"
#include "src/core/renderer.h"

namespace promenade::walkthrough {

/// Has a frame made, or reads it. The frame has `camera` and every map of its size.
using FrameMaker = std::function<Frame(const Camera& camera, int frameIndex)>;

/// For walks whose holes stay (Holes::kStay): retrace() puts colours of the surroundings where the source is
/// SampleSource::kUnknown, and leaves what keyframes sampled too coarsely as it is, or has the frame made if
/// both are too much. Materials are not known either: no item counts as view-dependent, and it is for the
/// metric to find what cannot be warped. Remembers nothing, so that parts of a walk can be rendered apart.
class FramesRenderer final : public Renderer {
 public:
  /// `mostUnknownPercent`: of the samples of a frame between keyframes; with more holes it is made, too. 100:
  /// never.
  FramesRenderer(FrameMaker make, const ibr::WarpSettings& warp, double mostUnknownPercent);

  /// Nothing is hit: without frames nothing is known.
  [[nodiscard]] Visibility visibility(const Camera& camera) const override;
  /// The nearest of the surfaces in all of these frames, warped forward. Where none shows anything: depth
  /// +inf, no item.
  [[nodiscard]] Visibility visibilityAmong(const Camera& camera,
                                           std::span<const Frame* const> known) const override;
  /// `source` is not used: a frame that is made becomes SampleSource::kTraced, all of it.
  void retrace(Frame& frame, const Mask& mask, SampleSource source, int frameIndex) const override;
  [[nodiscard]] Frame render(const Camera& camera, int frameIndex) const override;
  [[nodiscard]] ItemTraits traits(ItemId) const override { return {}; }
  [[nodiscard]] RayCounts rayCounts() const override { return {}; }

 private:
  FrameMaker make_;
  ibr::WarpSettings warp_;
  double mostUnknownPercent_;
};

/// Gives the samples that `open` selects the mean colour of the known samples around them, from the rim of
/// each hole inwards; of these the far ones, as what comes into view is what a nearer surface hid.
[[nodiscard]] RadianceMap surroundings(const RadianceMap& radiance, const DepthMap& depth, const Mask& open);

}  // namespace promenade::walkthrough
