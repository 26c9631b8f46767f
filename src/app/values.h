#pragma once
// Option values that are more than one number. Every function throws InputError that begins with `option`.

#include <glm/vec2.hpp>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "src/app/ocio_options.h"
#include "src/core/image.h"
#include "src/core/tone_mapping.h"

namespace promenade::app {

/// A finite number, the whole text, in [low, high].
[[nodiscard]] double numberFrom(const std::string& text, double low, double high, const std::string& option);
[[nodiscard]] int integerFrom(const std::string& text, int low, int high, const std::string& option);

/// "1280x720", each side from 1 to 65536.
[[nodiscard]] Size sizeFrom(const std::string& text, const std::string& option);

struct Frames {
  int first;
  int last;  ///< inclusive
};
/// "A-B" or "A" of `count` frames, numbered from 0.
[[nodiscard]] Frames framesFrom(const std::string& text, int count, const std::string& option);

/// "VX,VY"
[[nodiscard]] glm::vec2 pairFrom(const std::string& text, const std::string& option);

struct Crop {
  int x, y;
  Size size;
};
/// "WxH+X+Y"
[[nodiscard]] Crop cropFrom(const std::string& text, const std::string& option);

/// One of allToneCurves(), by its name.
[[nodiscard]] ToneCurve toneFrom(const std::string& text, const std::string& option);

/// cd/m2 that a radiance of 1 stands for, or nothing for "auto".
[[nodiscard]] std::optional<double> unitFrom(const std::string& text, const std::string& option);

/// A number of stops, or nothing for "auto".
[[nodiscard]] std::optional<double> exposureFrom(const std::string& text, const std::string& option);

struct ToneOptions {
  ToneCurve curve = ToneCurve::kNeutral;
  std::optional<double> exposureEv;        ///< nothing: automatic
  std::optional<double> candelasPerUnit;   ///< nothing: automatic
  std::shared_ptr<const ColourView> view;  ///< of ToneCurve::kOcio, else null
};
/// --tone, --exposure, --unit and --ocio together: the unit is for tones of the eye, and a given exposure
/// already says what it is (candelasFromExposure()). No tone is neutral, with anything of --ocio it is that.
[[nodiscard]] ToneOptions toneOptionsFrom(const std::string& tone, const std::string& exposure,
                                          const std::string& unit, const OcioOptions& ocio = {});

/// One of `choices` (the text itself); names the nearest otherwise.
[[nodiscard]] std::string choiceFrom(const std::string& text, std::span<const std::string_view> choices,
                                     const std::string& option);
[[nodiscard]] std::string choiceFrom(const std::string& text, std::initializer_list<std::string_view> choices,
                                     const std::string& option);

}  // namespace promenade::app
