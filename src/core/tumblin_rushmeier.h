#pragma once
// Equal brightness: what a viewer of the display sees is as bright as what the walker saw, by Stevens' power
// law. Tumblin, Rushmeier 1993; McNamara, Chalmers, Troscianko 2000, section 3.3.1.

namespace promenade {

/// Exponent and logarithm of the factor of Stevens' law, B = 10^beta L^alpha (B in brils, L in lamberts), for
/// an eye adapted to `adaptation` cd/m2. Tumblin and Rushmeier 1993, of the logarithm l of the adaptation in
/// lamberts: alpha = 0.4 l + 2.92, beta = -0.4 l^2 - 2.584 l + 2.0208. Below 0.01 cd/m2, where no measurement
/// is and alpha would fall to 0, as at 0.01.
[[nodiscard]] double stevensAlpha(double adaptation);
[[nodiscard]] double stevensBeta(double adaptation);

class TumblinRushmeier {
 public:
  /// What the eye is adapted to in the world and at the display, cd/m2, > 0.
  TumblinRushmeier(double worldAdaptation, double displayAdaptation);
  /// cd/m2 on the display for cd/m2 >= 0 in the world.
  [[nodiscard]] double operator()(double worldLuminance) const;

 private:
  double power_;
  double factor_;
};

}  // namespace promenade
