#pragma once
// The filters of the cortex transform: octave bands of frequency ("dom") times six fans of orientation.
// Watson 1987, Daly 1993, section 5. Departures from Daly: the SQUARES of the filters sum to 1, not their
// amplitudes (the response to a grating then does not ripple with its frequency and orientation), and the
// baseband is what the bands leave over instead of a Gaussian. docs/method.md has the reasons and what they
// bring.

#include <glm/vec2.hpp>

namespace promenade::aqm {

/// Daly's number of orientations.
inline constexpr int kOrientations = 6;
/// In the place of an orientation: the baseband's, which has none.
inline constexpr int kUnoriented = -1;

/// The unit vector at l * 180/n degrees, l = 0 .. n-1: across the bars of a grating that orientation l of n
/// is centred on. Exact on the axes.
[[nodiscard]] glm::dvec2 acrossBars(int orientation, int orientations = kOrientations);

/// A spatial frequency as the discrete Fourier transform numbers it, cycles per pixel in [-1/2, 1/2]. On an
/// even-sized image -1/2 and 1/2 are one and the same frequency (Nyquist's): name it -1/2 and say so.
struct Frequency {
  double x = 0.0;
  double y = 0.0;
  bool xIsNyquist = false;
  bool yIsNyquist = false;
};

/// Frequency number `index` of a transform of `length` samples, cycles per pixel in [-1/2, 1/2).
[[nodiscard]] double signedFrequency(int index, int length);

/// mesa(f, h): 1 at low frequencies, half amplitude at `half`, 0 from 4/3 `half` on; a raised cosine between.
[[nodiscard]] double mesa(double frequency, double half);

/// sqrt(dom_k), k = 1 (finest) .. K: band k passes (2/3) 2^-k < f < (8/3) 2^-k cycles per pixel; band 1
/// everything above 1/3.
[[nodiscard]] double bandAmplitude(double frequency, int band);

/// sqrt(mesa(f, 2^-K)): what the K bands leave over.
[[nodiscard]] double basebandAmplitude(double frequency, int bands);

/// sqrt(fan_l), l = 0 .. n-1: passes frequency vectors within 180/n degrees of the direction l * 180/n
/// degrees (l = 0: along x, so vertical bars); fan_l = 1/2 (1 + cos(n d)). 1 for n = 1. The mean of the
/// squares of both names of a Nyquist frequency, which keeps a filtered real image real. 1 in orientation 0
/// and 0 in the others at frequency 0, where every band is 0 anyway.
[[nodiscard]] double fanAmplitude(const Frequency& frequency, int orientation,
                                  int orientations = kOrientations);

/// Centre frequency of band k, 4/3 2^-k cycles per pixel.
[[nodiscard]] double bandCentre(int band);

/// Centre frequency of the baseband, half its edge 2^-K, cycles per pixel.
[[nodiscard]] double basebandCentre(int bands);

}  // namespace promenade::aqm
