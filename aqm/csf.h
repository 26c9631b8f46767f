#pragma once
// The contrast sensitivity of the eye: to a pattern that moves over the retina, and, from two other sources,
// to a static one. S(rho, v) = c0 c2 k v (2 pi c1 rho)^2 exp(-4 pi c1 rho / rmax), k = 6.1 + 7.3 |log10(c2 v
// / 3)|^3, rmax = 45.9 / (c2 v + 2): Kelly 1979, eq. (8), with the constants of Daly 1998 (c0 = 1.14, c1 =
// 0.67, c2 = 1.7), who fits it to natural viewing.

namespace promenade::aqm {

/// The slowest the retinal image ever moves, degrees per second: the eye drifts (Daly 1998).
inline constexpr double kDriftSpeed = 0.15;

/// The part of S that depends on the speed alone, so that
/// S(rho, v) = speedGain(v) rho^2 exp(-rho frequencyDecay(v)). `degreesPerSecond` > 0.
[[nodiscard]] double speedGain(double degreesPerSecond);

/// See speedGain(); in degrees, so that frequencyDecay(v) rho has no unit. Linear in the speed.
[[nodiscard]] double frequencyDecay(double degreesPerSecond);

/// 1 / threshold contrast of a grating of `cyclesPerDegree` >= 0 that moves over the retina at
/// `degreesPerSecond` > 0. S(0, v) = 0.
[[nodiscard]] double sensitivity(double cyclesPerDegree, double degreesPerSecond);

/// Under which conditions Daly's static CSF is wanted.
struct Adaptation {
  double luminance = 100.0;          ///< that the eye is adapted to, cd/m2, > 0
  double squareDegrees = 64.0;       ///< area of the image, > 0
  double distanceMetres = 0.5;       ///< to the display, > 0
  double eccentricityDegrees = 0.0;  ///< from the centre of gaze, >= 0
};

/// Daly 1993, section 4 (peak 250): light adaptation, image area, accommodation to the distance, eccentricity
/// and the oblique effect for a frequency vector at `angle` radians from horizontal. S(0) = 0.
[[nodiscard]] double dalySensitivity(double cyclesPerDegree, double angle, const Adaptation& adaptation);

/// What turns sensitivity(rho, v) into the CSF of Csf::kDalyMoving, S(rho, v) = S_Daly(rho) S_Kelly(rho, v) /
/// S_Kelly(rho, 0.15): Kelly's formula, fitted to gratings of up to 12 cycles per degree, falls off too
/// steeply above (12 dB too low at 22.6, 23 dB at 30) and below 1 cycle per degree; Daly's static one does
/// not. 0 at frequency 0.
[[nodiscard]] double stillFactor(double cyclesPerDegree, const Adaptation& adaptation);

/// Mannos, Sakrison 1974: 2.6 (0.0192 + 0.114 rho) exp(-(0.114 rho)^1.1), which peaks at 0.98 at 8 cycles per
/// degree, times 250; but S(0) = 0, as for the others.
[[nodiscard]] double mannosSakrisonSensitivity(double cyclesPerDegree);

}  // namespace promenade::aqm
