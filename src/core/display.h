#pragma once
// What a display makes of code values: light on the viewer's retina. The frames a viewer gets and the frames
// the metric judges are shown by the same DisplayModel.

#include <string>

#include "src/core/image.h"
#include "src/core/primaries.h"

namespace promenade {

/// Luminance of linear Rec.709 (ITU-R BT.709-6, 3.2: derived from primaries and white D65).
[[nodiscard]] float luminance(const Rgb& linear);

/// sRGB transfer function (IEC 61966-2-1), applied to values in [0, 1]; odd extension below 0.
[[nodiscard]] float encodeSrgb(float linear);
[[nodiscard]] float decodeSrgb(float encoded);

enum class TransferFunction { kSrgb, kGamma, kLinear };

/// Which code values the pictures for a display are given.
enum class Signal {
  kSrgb,    ///< those of sRGB, whatever the display makes of them
  kNative,  ///< its own: converted to its primaries and by its transfer function
};

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
  double gamma = 2.2;  ///< of TransferFunction::kGamma
  Primaries primaries;
  Signal signal = Signal::kSrgb;

  /// Pixels per degree of visual angle at the centre of the screen.
  [[nodiscard]] double pixelsPerDegree() const;
  /// The linear drive of one light in [0, 1] for a code value in [0, 1], and back; clamped.
  [[nodiscard]] float decoded(float code) const;
  [[nodiscard]] float encoded(float drive) const;
  /// cd/m2 of the ambient light on the screen, and with it of a black pixel.
  [[nodiscard]] double reflectedLuminance() const;
  [[nodiscard]] double darkLuminance() const { return blackLuminance + reflectedLuminance(); }
  /// cd/m2 that an eye at the display is adapted to: half of its white (Ward 1994).
  [[nodiscard]] double adaptationLuminance() const { return peakLuminance / 2.0; }
  /// The shares of its three lights in the luminance of its white.
  [[nodiscard]] Rgb luminanceWeights() const;
  /// Luminance of an encoded value, cd/m2: dark + (peak - black) * Y(decoded), at least 1e-4.
  [[nodiscard]] float luminanceOf(const Rgb& encoded) const;
  /// The same for many values: `weights` are luminanceWeights().
  [[nodiscard]] float luminanceOf(const Rgb& encoded, const Rgb& weights) const;
};

/// What a viewer's eye gets from an encoded image on this display.
[[nodiscard]] LuminanceMap displayLuminance(const EncodedMap& encoded, const DisplayModel& display);

}  // namespace promenade
