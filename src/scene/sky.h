#pragma once
// A clear daylight sky: A. J. Preetham, P. Shirley, B. Smits, "A Practical Analytic Model for Daylight",
// SIGGRAPH 1999.
//
// Departures: luminance is scaled so that the zenith has 1 (scene units); colours outside Rec.709 are cut at
// 0; the sun's transmittance (appendix A.1) is evaluated at one wavelength a channel, with Rayleigh and
// aerosol extinction only; the disc is spread over a wider, soft lobe of the same irradiance, so that a map
// of moderate size can hold it; below the horizon lies diffuse ground of albedo 0.2 that sky and sun light.

#include "src/scene/scene.h"

namespace promenade {

enum class SunDisc { kNone, kSoft };

/// The sun stands at world direction (sin a cos e, sin e, -cos a cos e) for azimuth a and elevation e:
/// azimuth 0 is toward -Z, a quarter turn toward +X. Elevation in [0, pi/2], turbidity in [1.7, 10] (2 very
/// clear, 4 hazy); InputError otherwise. Everywhere positive; luminance 1 at the zenith (without the sun).
[[nodiscard]] Environment clearSky(double sunElevationRadians, double sunAzimuthRadians, double turbidity,
                                   SunDisc sun = SunDisc::kSoft);

}  // namespace promenade
