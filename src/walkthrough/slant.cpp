#include "src/walkthrough/slant.h"

#include "src/core/display.h"

namespace promenade::walkthrough {
namespace {

/// Of what a sample shows, by what its gloss may have changed. Measured (docs/method.md), it has changed by
/// half of that in most samples, in broad bands: 2 or 3 per cent of contrast, about what the metric finds
/// visible.
constexpr float kLargestContrast = 0.05f;

/// Which part of its radiance a sample reflects glossily, in [0, 1]; NaN for black.
float shareOfGloss(const Frame& frame, int x, int y) {
  const float gloss = luminance(frame.viewDependent(x, y));
  return gloss / (gloss + luminance(frame.diffuse(x, y)));
}

}  // namespace

Mask holesAndSlantedGloss(const ibr::Blended& blended, const Mask& looksTheSame) {
  const Frame& frame = blended.frame;
  Mask selected = blended.holes.clone();
  for (int y = 0; y < selected.height(); ++y) {
    for (int x = 0; x < selected.width(); ++x) {
      const float change = blended.slantChange(x, y);
      if (!(change > kLargestContrast) || looksTheSame(x, y) == 0) continue;
      if (shareOfGloss(frame, x, y) * change > kLargestContrast) selected(x, y) = 1;
    }
  }
  return selected;
}

}  // namespace promenade::walkthrough
