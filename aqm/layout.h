#pragma once
// How many bands an image is split into, and how far it is extended so that the filters do not wrap around.

#include "src/core/image.h"

namespace promenade::aqm {

/// The number of frequency bands K besides the baseband, whose edge 2^-K ppd is then at most 1 cycle per
/// degree; >= 2.
[[nodiscard]] int bandCount(double pixelsPerDegree);

/// `image` pixels sit at (margin, margin) in a periodic image of `padded` pixels.
struct Layout {
  Size image;
  Size padded;
  int margin = 0;
  int bands = 0;
  double pixelsPerDegree = 0.0;

  /// Columns of the half spectrum of a real image.
  [[nodiscard]] int spectrumColumns() const { return padded.width / 2 + 1; }
};

/// Margin 2^(K-1) before the image; each side the smallest multiple of 2^(K-2), with no prime factor above 5
/// beside it, that leaves a margin after the image too.
[[nodiscard]] Layout layoutOf(Size image, double pixelsPerDegree, int bands);
/// With bandCount() bands.
[[nodiscard]] Layout layoutOf(Size image, double pixelsPerDegree);

/// The sample that half-sample symmetric reflection (.. b a | a b .. y z | z y ..) puts at `index`, any
/// integer, of a row of `count` >= 1 samples.
[[nodiscard]] int reflected(int index, int count);

}  // namespace promenade::aqm
