#pragma once
// Equal visibility by cones and rods, with the loss of colour and acuity in the dark, and the time that the
// eye takes. Ferwerda, Pattanaik, Shirley, Greenberg 1996, A model of visual adaptation for realistic image
// synthesis; McNamara, Chalmers, Troscianko 2000, section 3.3.1.

#include "src/core/adaptation.h"
#include "src/core/image.h"

namespace promenade {

/// The least visible difference, cd/m2 (photopic of cones, scotopic of rods), for an eye adapted to
/// `adaptation` cd/m2: Ferwerda et al., figure 2.
[[nodiscard]] double coneThreshold(double adaptation);
[[nodiscard]] double rodThreshold(double adaptation);

/// How much of the rods' picture is seen: 1 in the light of stars, 0 in that of day, in between over the
/// mesopic range of 0.01 to 10 cd/m2 (its square law: Durand, Dorsey 2000).
[[nodiscard]] double rodShare(double adaptation);

/// Scotopic luminance, scotopic cd/m2, of linear Rec.709 in cd/m2: V = Y (1.33 (1 + (Y + Z) / X) - 1.68)
/// (Larson, Rushmeier, Piatko 1997, section 5.4).
[[nodiscard]] double scotopicLuminance(const Rgb& candelas);

/// The finest grating that is seen at full contrast, cycles per degree: 17.25 arctan(1.4 log10 La + 0.35)
/// + 25.72 (Larson, Rushmeier, Piatko 1997, section 5.5, of Shaler's measurements). Below 1e-4 cd/m2, where
/// nothing was measured, as there.
[[nodiscard]] double acuity(double adaptation);

/// Standard deviation, degrees, of the Gaussian that takes from a picture on the display what the walker does
/// not resolve. A Gaussian stands for an eye adapted to La if it lowers the grating of its acuity from full
/// contrast to the least one that is visible on the display, coneThreshold(Ld) / Ld. The eye at the display
/// blurs as well, so only the difference of the variances is added; 0 where the walker sees as finely.
[[nodiscard]] double acuityBlurDegrees(double worldAdaptation, double displayAdaptation);

class Ferwerda {
 public:
  Ferwerda(const Adaptation& world, double displayAdaptation);
  /// Linear Rec.709 in cd/m2, on the display for in the world; of a luminance that may be below 0 while the
  /// eye adapts.
  [[nodiscard]] Rgb operator()(const Rgb& candelas) const;

 private:
  struct Scales {
    double cones, rods;
  };
  [[nodiscard]] static Scales scalesAt(double adaptation, double displayAdaptation);

  Scales scales_;
  double offset_;  // cd/m2
};

}  // namespace promenade
