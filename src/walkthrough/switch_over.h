#pragma once
// When does a composite progression go on from light that is found by chance to light that is computed? The
// published heuristic: Volevich, Myszkowski, Khodulev, Kopylov 2000 (Using the Visual Differences Predictor
// to Improve Performance of Progressive Global Illumination Computation), as McNamara, Chalmers, Troscianko
// (eds.) 2000 give it in section 4.3.2.
//
// Departures: there the stochastic part is photon tracing and only direct light is replaced; here it is path
// tracing, and a light solution replaces what paths found of both (preview.h). So E is the error of the whole
// picture, not of its indirect light.

namespace promenade::walkthrough {

struct SwitchOver {
  double alpha = 0.1;  ///< share of T_i0 after which the error is looked at
  double leastSamplingSeconds = 0.5;
  double errorThreshold = 0.15;  ///< E_thr, RMS: a reasonable approximation of indirect light

  /// T_alpha = alpha T_i0, at least half a second. T_i0: seconds until the first picture by computed light is
  /// there.
  [[nodiscard]] double samplingSeconds(double firstComputed) const;
  /// T_1 = min(T_alpha E^2 / E_thr^2, T_i0): seconds of stochastic light in all. E: its RMS error after
  /// T_alpha, which falls with the root of time.
  [[nodiscard]] double seconds(double sampling, double error, double firstComputed) const;
};

}  // namespace promenade::walkthrough
