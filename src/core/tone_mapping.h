#pragma once
// From radiance to a display's code values. The frames a viewer gets and the frames the metric judges go
// through the same ToneMapping.

#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>

#include "src/core/adaptation.h"
#include "src/core/chiu.h"
#include "src/core/colour_view.h"
#include "src/core/display.h"
#include "src/core/image.h"

namespace promenade {

enum class ToneCurve {
  kNeutral,  ///< Khronos PBR Neutral (tone_curves.h)
  kLinear,   ///< clipped at 1
  kAgx,      ///< filmic; bright colours run to white
  kSchlick,  ///< rational
  kChiu,     ///< linear, but every place scaled by what surrounds it
  kOcio,     ///< a view of an OpenColorIO config
  // Models of the eye: of an eye adapted to the world, and to half of the display's white.
  kTumblinRushmeier,  ///< equal brightness
  kWard,              ///< equal contrast thresholds
  kFerwerda,          ///< the same of cones and rods; colour and detail are lost in the dark
  kLarson,            ///< what is there shares the display's range, no contrast more visible than it is
};

[[nodiscard]] std::span<const ToneCurve> allToneCurves();
/// As options and reports have it.
[[nodiscard]] const char* nameOf(ToneCurve curve);
/// Whether it asks for luminances in cd/m2, for adaptation and for the display, instead of an exposure.
[[nodiscard]] bool modelsTheEye(ToneCurve curve);

/// What the pictures of one frame go through; two frames that are compared have the same.
class FrameTone {
 public:
  using Curve = std::function<Rgb(const Rgb&)>;
  using Coding = std::function<Rgb(const Rgb&)>;
  FrameTone(Curve curve, Coding coding) : curve_(std::move(curve)), coding_(std::move(coding)) {}

  /// The walker does not see as finely as the viewer: standard deviation of a Gaussian, pixels.
  [[nodiscard]] FrameTone blurredBy(double pixels) &&;
  /// Every place is scaled by its surroundings (chiu.h), of radiance times `exposure`.
  [[nodiscard]] FrameTone scaledBySurroundings(float exposure) &&;

  /// Of pictures of this frame, one or two that are to be compared; of a tone that knows of none, nothing.
  [[nodiscard]] Surroundings around(std::initializer_list<const RadianceMap*> pictures) const;

  /// The linear drive signal in [0, 1], in Rec.709, for a radiance; of ToneCurve::kOcio the code values,
  /// which code() then leaves as they are. Not-a-number and negative radiance are 0.
  [[nodiscard]] Rgb drive(const Rgb& radiance) const;
  [[nodiscard]] double blur() const { return blur_; }
  [[nodiscard]] bool asksForSurroundings() const { return surroundingsExposure_.has_value(); }
  /// Code values for a drive signal.
  [[nodiscard]] Rgb code(const Rgb& drive) const { return coding_(drive); }

 private:
  Curve curve_;
  Coding coding_;
  double blur_ = 0.0;
  std::optional<float> surroundingsExposure_;
};

/// One mapping for a whole walkthrough.
struct ToneMapping {
  ToneCurve curve = ToneCurve::kNeutral;
  double exposureEv = 0.0;       ///< radiance is multiplied by 2^exposureEv before a curve that is no model
  double candelasPerUnit = 1.0;  ///< for the models: cd/m2 of a radiance of 1
  AdaptationCurve adaptation = {};                   ///< for the models
  std::shared_ptr<const ColourView> view = nullptr;  ///< for kOcio, never null there

  [[nodiscard]] FrameTone at(int frame, const DisplayModel& display) const;
};

/// cd/m2 of a radiance of 1 in a scene that does not say, from its exposure: what that makes white, 1, is
/// white paper in the light of an office, 500 lux (EN 12464-1), 500 / pi cd/m2.
[[nodiscard]] double candelasFromExposure(double exposureEv);

/// Drive signal, then code values, of sRGB or the display's own (DisplayModel::signal), of single points.
[[nodiscard]] EncodedMap encodePoints(const RadianceMap& radiance, const FrameTone& tone);
/// Of a picture, whose pixels are the display's: blurred and scaled as its surroundings ask for, then as
/// points. Of a picture that is compared with another one, the surroundings are those of both.
[[nodiscard]] EncodedMap encodeForDisplay(const RadianceMap& radiance, const FrameTone& tone,
                                          const Surroundings& surroundings);
/// Of a picture by itself.
[[nodiscard]] EncodedMap encodeForDisplay(const RadianceMap& radiance, const FrameTone& tone);

}  // namespace promenade
