#pragma once
// What the eyes of someone who walks are adapted to, frame by frame. It is known before the first frame is
// made and depends on the walk alone, so all frames of one instant, whoever made them, look the same.

#include <vector>

#include "src/core/image.h"
#include "src/core/light_histogram.h"

namespace promenade {

/// cd/m2, > 0.
struct Adaptation {
  double steady = 100.0;  ///< that the eye would adapt to if what it sees stayed
  double now = 100.0;     ///< that it is adapted to, which follows
};

/// Mean luminances of nearly square parts of an image, which are what the fovea takes in at a glance: Larson,
/// Rushmeier, Piatko 1997 take 1 degree, the 64 parts from left to right that are made here are 0.8 to 1.5
/// degrees for the usual fields of view. Fewer where the image is smaller. What is not finite does not count.
[[nodiscard]] std::vector<double> fovealLuminances(const RadianceMap& radiance, int columns = 64);

/// The geometric mean of luminances; each counts as at least 1/100 of their arithmetic mean, so that a black
/// corner does not decide. 0 if there is no light. Their order changes nothing.
[[nodiscard]] double logAverage(std::vector<double> luminances);

/// What is seen in one frame of a walk.
struct View {
  int frame = 0;
  double luminance = 0.0;         ///< log-average of the foveal luminances, cd/m2
  LightHistogram histogram = {};  ///< of them
};

/// The view of what an image shows: foveal luminances in units of `candelas` cd/m2.
[[nodiscard]] View viewOf(int frame, std::vector<double> luminances, double candelas);

/// dA/dt = (L - A) / tau, tau = s 0.4 s + (1 - s) 0.1 s, s = 0.04 / (0.04 + L): how far rods, which are
/// slower, see at L cd/m2 (Durand, Dorsey 2000; Krawczyk, Myszkowski, Seidel 2005, eq. 12 and 13). L of a
/// frame is interpolated between the views in its logarithm. The eye is adapted when the walk begins. The
/// regeneration of bleached pigment, which takes minutes, is not part of it.
class AdaptationCurve {
 public:
  /// 100 cd/m2 everywhere.
  AdaptationCurve() = default;
  /// Views in the order of their frames, at least one; frames before the first and after the last are as
  /// these.
  AdaptationCurve(std::vector<View> views, double framesPerSecond);

  [[nodiscard]] Adaptation at(int frame) const;
  /// The views' histograms, followed at the same rate and then interpolated between the views.
  [[nodiscard]] LightHistogram histogramAt(int frame) const;
  [[nodiscard]] const std::vector<View>& views() const { return views_; }

 private:
  std::vector<View> views_;
  std::vector<Adaptation> states_;          // of the frames from the first view's to the last one's
  std::vector<LightHistogram> histograms_;  // of the views, as far as the eye has followed
};

/// The frames whose views describe a walk: at most 8 a second, evenly, and the last one.
[[nodiscard]] std::vector<int> framesToView(int first, int last, double framesPerSecond);

}  // namespace promenade
