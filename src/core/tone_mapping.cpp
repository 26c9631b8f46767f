#include "src/core/tone_mapping.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "src/core/ferwerda.h"
#include "src/core/gaussian.h"
#include "src/core/histogram_adjustment.h"
#include "src/core/tone_curves.h"
#include "src/core/tumblin_rushmeier.h"
#include "src/core/ward.h"

namespace promenade {
namespace {

constexpr std::array kCurves = {ToneCurve::kNeutral,  ToneCurve::kLinear,           ToneCurve::kAgx,
                                ToneCurve::kSchlick,  ToneCurve::kTumblinRushmeier, ToneCurve::kWard,
                                ToneCurve::kFerwerda, ToneCurve::kLarson,           ToneCurve::kChiu,
                                ToneCurve::kOcio};

float cleaned(float value, float largest) {
  return value > 0.0f ? std::min(value, largest) : 0.0f;
}

Rgb cleaned(const Rgb& value, float largest) {
  return {cleaned(value.r, largest), cleaned(value.g, largest), cleaned(value.b, largest)};
}

// A curve that knows of no eye, behind its exposure.
FrameTone::Curve exposed(double stops, std::function<Rgb(const Rgb&)> curve) {
  return [scale = static_cast<float>(std::exp2(stops)), curve = std::move(curve)](const Rgb& radiance) {
    return curve(cleaned(radiance * scale, 1e6f));
  };
}

// A model of the eye, from cd/m2 to cd/m2, between the world's luminance and what drives the display to show
// the model's.
FrameTone::Curve seen(double candelasPerUnit, const DisplayModel& display,
                      std::function<Rgb(const Rgb&)> model) {
  const auto unit = static_cast<float>(candelasPerUnit);
  // Course notes, 3.3.1: the light that is on the screen anyway is not shown once more.
  const auto dark = static_cast<float>(display.darkLuminance());
  const auto range = static_cast<float>(display.peakLuminance - display.blackLuminance);
  return [=, model = std::move(model)](const Rgb& radiance) {
    return (model(cleaned(radiance * unit, 1e12f)) - Rgb(dark)) / range;
  };
}

// What the view makes of it are code values already.
FrameTone viewed(double stops, std::shared_ptr<const ColourView> view) {
  assert(view);
  return {exposed(stops, [view = std::move(view)](
                             const Rgb& radiance) { return cleaned(view->codes(radiance), 1.0f); }),
          [](const Rgb& codes) { return codes; }};
}

FrameTone::Coding codingFor(const DisplayModel& display) {
  if (display.signal == Signal::kSrgb) {
    return [](const Rgb& d) { return Rgb(encodeSrgb(d.r), encodeSrgb(d.g), encodeSrgb(d.b)); };
  }
  return [matrix = glm::mat3(rgbFromRec709(display.primaries)), display](const Rgb& drive) {
    const Rgb own = glm::clamp(matrix * drive, Rgb(0.0f), Rgb(1.0f));
    return Rgb(display.encoded(own.r), display.encoded(own.g), display.encoded(own.b));
  };
}

}  // namespace

std::span<const ToneCurve> allToneCurves() {
  return kCurves;
}

const char* nameOf(ToneCurve curve) {
  switch (curve) {
    case ToneCurve::kNeutral:
      return "neutral";
    case ToneCurve::kLinear:
      return "linear";
    case ToneCurve::kAgx:
      return "agx";
    case ToneCurve::kSchlick:
      return "schlick";
    case ToneCurve::kChiu:
      return "chiu";
    case ToneCurve::kTumblinRushmeier:
      return "tumblin-rushmeier";
    case ToneCurve::kWard:
      return "ward";
    case ToneCurve::kFerwerda:
      return "ferwerda";
    case ToneCurve::kLarson:
      return "larson";
    case ToneCurve::kOcio:
      return "ocio";
  }
  return "";
}

bool modelsTheEye(ToneCurve curve) {
  switch (curve) {
    case ToneCurve::kNeutral:
    case ToneCurve::kLinear:
    case ToneCurve::kAgx:
    case ToneCurve::kSchlick:
    case ToneCurve::kChiu:
    case ToneCurve::kOcio:
      return false;
    case ToneCurve::kTumblinRushmeier:
    case ToneCurve::kWard:
    case ToneCurve::kFerwerda:
    case ToneCurve::kLarson:
      return true;
  }
  return false;
}

double candelasFromExposure(double exposureEv) {
  return std::exp2(exposureEv) * 500.0 / std::numbers::pi;
}

Rgb FrameTone::drive(const Rgb& radiance) const {
  return glm::clamp(curve_(radiance), Rgb(0.0f), Rgb(1.0f));
}

FrameTone ToneMapping::at(int frame, const DisplayModel& display) const {
  const double world = adaptation.at(frame).now;
  const double screen = display.adaptationLuminance();
  const auto model = [&](std::function<Rgb(const Rgb&)> eye) {
    return FrameTone(seen(candelasPerUnit, display, std::move(eye)), codingFor(display));
  };
  const auto linear = [](const Rgb& value) { return value; };
  switch (curve) {
    case ToneCurve::kTumblinRushmeier:
      return model([brightness = TumblinRushmeier(world, screen)](const Rgb& candelas) {
        return withLuminance(candelas, brightness(static_cast<double>(luminance(candelas))));
      });
    case ToneCurve::kWard:
      return model(
          [m = static_cast<float>(wardScale(world, screen))](const Rgb& candelas) { return candelas * m; });
    case ToneCurve::kFerwerda:
      return model(Ferwerda(adaptation.at(frame), screen))
          .blurredBy(acuityBlurDegrees(world, screen) * display.pixelsPerDegree());
    case ToneCurve::kLarson: {
      const DisplayRange range{std::max(display.darkLuminance(), 1e-4),
                               display.peakLuminance + display.reflectedLuminance()};
      return model([adjusted = HistogramAdjustment(adaptation.histogramAt(frame), range, world, screen)](
                       const Rgb& candelas) {
        return withLuminance(candelas, adjusted(static_cast<double>(luminance(candelas))));
      });
    }
    case ToneCurve::kNeutral:
      return {exposed(exposureEv, neutralCurve), codingFor(display)};
    case ToneCurve::kAgx:
      return {exposed(exposureEv, agxCurve), codingFor(display)};
    case ToneCurve::kSchlick:
      return {exposed(exposureEv, schlick), codingFor(display)};
    case ToneCurve::kChiu:
      return FrameTone(exposed(exposureEv, linear), codingFor(display))
          .scaledBySurroundings(static_cast<float>(std::exp2(exposureEv)));
    case ToneCurve::kOcio:
      return viewed(exposureEv, view);
    case ToneCurve::kLinear:
      break;
  }
  return {exposed(exposureEv, linear), codingFor(display)};
}

FrameTone FrameTone::blurredBy(double pixels) && {
  blur_ = pixels;
  return std::move(*this);
}

FrameTone FrameTone::scaledBySurroundings(float exposure) && {
  surroundingsExposure_ = exposure;
  return std::move(*this);
}

Surroundings FrameTone::around(std::initializer_list<const RadianceMap*> pictures) const {
  if (!surroundingsExposure_) return {};
  return Surroundings(std::span(pictures.begin(), pictures.size()), *surroundingsExposure_);
}

EncodedMap encodeForDisplay(const RadianceMap& radiance, const FrameTone& tone) {
  return encodeForDisplay(radiance, tone, tone.around({&radiance}));
}

EncodedMap encodeForDisplay(const RadianceMap& radiance, const FrameTone& tone,
                            const Surroundings& surroundings) {
  if (!(tone.blur() > 0.0) && !tone.asksForSurroundings()) return encodePoints(radiance, tone);
  RadianceMap picture = radiance.clone();
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      picture(x, y) = surroundings.scaleAt(glm::vec2(x, y) + 0.5f) * cleaned(picture(x, y), 1e12f);
    }
  }
  return encodePoints(blurred(picture, tone.blur()), tone);
}

EncodedMap encodePoints(const RadianceMap& radiance, const FrameTone& tone) {
  EncodedMap encoded(radiance.size());
  const auto in = radiance.pixels();
  const auto out = encoded.pixels();
  for (std::size_t i = 0; i < in.size(); ++i) out[i] = tone.code(tone.drive(in[i]));
  return encoded;
}

}  // namespace promenade
