#pragma once
// The display's range shared out among the luminances that are there, but nothing is shown with more visible
// contrast than it has. Larson, Rushmeier, Piatko 1997, A visibility matching tone reproduction operator for
// high dynamic range scenes, sections 4.1 to 4.5; McNamara, Chalmers, Troscianko 2000, section 3.3.2.

#include <vector>

#include "src/core/light_histogram.h"

namespace promenade {

/// The least visible difference, cd/m2, to an eye adapted to `luminance` cd/m2, of cones and rods, whichever
/// see better (Larson et al., table 1; coneThreshold() and rodThreshold()).
[[nodiscard]] double leastVisible(double luminance);

/// What a display shows, cd/m2, 0 < dark < white.
struct DisplayRange {
  double dark = 0.5;
  double white = 100.0;
};

class HistogramAdjustment {
 public:
  /// `worldAdaptation` and `displayAdaptation` decide only where a world goes whose range is smaller than the
  /// display's.
  HistogramAdjustment(const LightHistogram& histogram, DisplayRange display, double worldAdaptation,
                      double displayAdaptation);

  /// cd/m2 on the display for cd/m2 >= 0 in the world: rising, and continuous where all shares are above 0.
  [[nodiscard]] double operator()(double worldLuminance) const;

 private:
  int first_ = 0;  // bin of the first node
  std::vector<double>
      nodes_;  // log10 of the display's luminance, of bins from the first to the last with light
};

}  // namespace promenade
