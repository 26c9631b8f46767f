#pragma once
// When is a frame done? When a viewer does not see the difference between the image after T paths a sample
// and the image after T/2: VDP(I_T, I_0.5T) bounds VDP(I_converged, I_T). Decided tile by tile, so that easy
// parts of a frame stop early. Source: Myszkowski 1998; McNamara, Chalmers, Troscianko (eds.) 2000,
// section 4.3.3 (alpha = 0.5).

#include "src/walkthrough/walkthrough.h"

namespace promenade::walkthrough {

/// Would two frames, each as far from convergence as this one, differ visibly at a pixel whose pooled JND
/// between I_T and I_0.5T is this?
[[nodiscard]] bool isPredictedVisible(float pooledJnd);
/// Per cent of the pixels for which that is so.
[[nodiscard]] double predictedPercent(const JndMap& pooledJnd);

/// Traces the samples of `frame` (settings.size times settings.supersample, with its visibility) that `mask`
/// selects, by settings.stopping, which must be there: rule.firstPaths, then as many again, and so on, of
/// those that stand in a tile a viewer would see a difference in. Samples that are not selected are part of
/// the image and do not change, but between noisy ones of their item they are judged to be as noisy as what
/// is interpolated from these, over up to 2 display pixels. The image is seen at rest, which shows more than
/// motion does. Marks the samples SampleSource::kTraced. Adds to the parts `trace` and `metric` of `seconds`.
/// The result is the same for any number of threads.
[[nodiscard]] StoppingStatistics traceUntilInvisible(Frame& frame, const Mask& mask, int frameIndex,
                                                     const Renderer& renderer, const Settings& settings,
                                                     PartSeconds& seconds);

/// A renderer whose samples are done when a viewer says so: whoever renders with it need not know of paths.
/// render() and retrace() stop by settings.stopping, which must be there; all else is the other renderer's.
/// Frames have settings.size times settings.supersample samples. For one thread at a time.
class StoppingRenderer final : public Renderer {
 public:
  /// Both must outlive this.
  StoppingRenderer(const Renderer& renderer, const Settings& settings);

  [[nodiscard]] Visibility visibility(const Camera& camera) const override;
  [[nodiscard]] Visibility visibilityAmong(const Camera& camera,
                                           std::span<const Frame* const> known) const override;
  void retrace(Frame& frame, const Mask& mask, SampleSource source, int frameIndex) const override;
  [[nodiscard]] Refined refine(Frame& frame, const Mask& mask, PathRange paths,
                               int frameIndex) const override;
  [[nodiscard]] Frame render(const Camera& camera, int frameIndex) const override;
  [[nodiscard]] ItemTraits traits(ItemId item) const override;
  [[nodiscard]] RayCounts rayCounts() const override;

  /// Since the last call: paths and tiles of all that was traced, per cent of all pixels together.
  [[nodiscard]] StoppingStatistics spent() const;
  /// That all of it took, of the time inside render() and retrace().
  [[nodiscard]] double secondsInMetric() const { return seconds_.metric; }

 private:
  void trace(Frame& frame, const Mask& mask, int frameIndex) const;

  const Renderer& renderer_;
  const Settings& settings_;
  mutable StoppingStatistics spent_;
  mutable PartSeconds seconds_;
};

}  // namespace promenade::walkthrough
