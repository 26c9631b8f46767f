#pragma once
// From radiance to light on the viewer's retina. The frames a viewer gets and the frames the metric judges go
// through the same ToneMapping and the same DisplayModel.

#include <string>

#include "src/core/image.h"

namespace promenade {

/// Luminance of linear Rec.709 (ITU-R BT.709-6, 3.2: derived from primaries and white D65).
[[nodiscard]] float luminance(const Rgb& linear);

/// sRGB transfer function (IEC 61966-2-1), applied to values in [0, 1]; odd extension below 0.
[[nodiscard]] float encodeSrgb(float linear);
[[nodiscard]] float decodeSrgb(float encoded);

enum class ToneCurve {
  kLinear,   ///< clipped at 1
  kNeutral,  ///< Khronos PBR Neutral: identity up to 0.8 less the Fresnel offset, highlights compressed, hue
             ///< kept
};

/// One global mapping for a whole walkthrough: every frame, and both frames of every comparison, use the
/// same.
struct ToneMapping {
  ToneCurve curve = ToneCurve::kNeutral;
  double exposureEv = 0.0;  ///< radiance is multiplied by 2^exposureEv before the curve
};

/// The display's linear drive signal in [0, 1] for a radiance. Not-a-number and negative radiance become 0.
[[nodiscard]] Rgb toneMap(const Rgb& radiance, const ToneMapping& tone);
/// toneMap() followed by the sRGB transfer function.
[[nodiscard]] EncodedMap encodeForDisplay(const RadianceMap& radiance, const ToneMapping& tone);

enum class TransferFunction { kSrgb, kGamma22, kLinear };

struct DisplayModel {
  std::string name;
  Size resolution{1920, 1080};
  double diagonalMetres = 0.61;        ///< of the visible screen
  double viewingDistanceMetres = 0.6;  ///< eye to screen
  double peakLuminance = 250.0;        ///< cd/m2 of white
  double blackLuminance = 0.25;        ///< cd/m2 of black in a dark room
  double ambientIlluminance = 50.0;    ///< lux that falls on the screen
  double screenReflectance = 0.01;     ///< diffuse: reflected luminance is E * reflectance / pi
  TransferFunction transfer = TransferFunction::kSrgb;

  /// Pixels per degree of visual angle at the centre of the screen.
  [[nodiscard]] double pixelsPerDegree() const;
  /// Luminance of an encoded value, cd/m2: black + reflected + (peak - black) * Y(decoded), at least 1e-4.
  [[nodiscard]] float luminanceOf(const Rgb& encoded) const;
};

/// What a viewer's eye gets from an encoded image on this display.
[[nodiscard]] LuminanceMap displayLuminance(const EncodedMap& encoded, const DisplayModel& display);

}  // namespace promenade
