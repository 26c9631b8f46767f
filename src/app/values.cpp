#include "src/app/values.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "src/app/printable.h"
#include "src/core/errors.h"
#include "src/core/nearest_name.h"

namespace promenade::app {
namespace {

constexpr int kLargestSide = 65536;

std::string shown(double value) {
  char buffer[32];
  const auto result = std::to_chars(buffer, buffer + sizeof(buffer), value, std::chars_format::general, 9);
  return std::string(buffer, result.ptr);
}

[[noreturn]] void refuse(const std::string& option, const std::string& expected, const std::string& found) {
  throw InputError(option, "expected " + expected + ", found '" + printable(found.substr(0, 80)) + "'");
}

// The whole text as a T; nothing if it is anything else.
template <class T>
std::optional<T> parsed(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// Splits at the first `separator` after the first character (so that a sign is not taken for one).
std::optional<std::pair<std::string, std::string>> split(const std::string& text, char separator) {
  const std::size_t at = text.find(separator, 1);
  if (text.empty() || at == std::string::npos) return std::nullopt;
  return std::pair(text.substr(0, at), text.substr(at + 1));
}

std::optional<Size> sizeIn(const std::string& text) {
  const auto sides = split(text, 'x');
  if (!sides) return std::nullopt;
  const auto width = parsed<int>(sides->first);
  const auto height = parsed<int>(sides->second);
  const auto good = [](const std::optional<int>& side) {
    return side && *side >= 1 && *side <= kLargestSide;
  };
  if (!good(width) || !good(height)) return std::nullopt;
  return Size{*width, *height};
}

}  // namespace

double numberFrom(const std::string& text, double low, double high, const std::string& option) {
  const auto value = parsed<double>(text);
  if (!value || !(*value >= low && *value <= high)) {
    refuse(option, "a number from " + shown(low) + " to " + shown(high), text);
  }
  return *value;
}

int integerFrom(const std::string& text, int low, int high, const std::string& option) {
  const auto value = parsed<int>(text);
  if (!value || *value < low || *value > high) {
    refuse(option, "a whole number from " + std::to_string(low) + " to " + std::to_string(high), text);
  }
  return *value;
}

Size sizeFrom(const std::string& text, const std::string& option) {
  const auto size = sizeIn(text);
  if (!size) refuse(option, "WIDTHxHEIGHT, each from 1 to " + std::to_string(kLargestSide) + " pixels", text);
  return *size;
}

Frames framesFrom(const std::string& text, int count, const std::string& option) {
  const auto ends = split(text, '-');
  const auto first = parsed<int>(ends ? ends->first : text);
  const auto last = parsed<int>(ends ? ends->second : text);
  if (!first || !last || *first < 0 || *last < *first) refuse(option, "FIRST-LAST, numbered from 0", text);
  if (*last >= count) {
    throw InputError(option, "expected frames within 0-" + std::to_string(count - 1) +
                                 ", all that there are, found '" + printable(text) + "'");
  }
  return {*first, *last};
}

glm::vec2 pairFrom(const std::string& text, const std::string& option) {
  const auto parts = split(text, ',');
  const auto x = parts ? parsed<float>(parts->first) : std::nullopt;
  const auto y = parts ? parsed<float>(parts->second) : std::nullopt;
  if (!x || !y || !std::isfinite(*x) || !std::isfinite(*y)) refuse(option, "two numbers X,Y", text);
  return {*x, *y};
}

Crop cropFrom(const std::string& text, const std::string& option) {
  const std::string expected = "WIDTHxHEIGHT+X+Y";
  const auto sizeAndRest = split(text, '+');
  const auto xAndY = sizeAndRest ? split(sizeAndRest->second, '+') : std::nullopt;
  const auto size = sizeAndRest ? sizeIn(sizeAndRest->first) : std::nullopt;
  const auto x = xAndY ? parsed<int>(xAndY->first) : std::nullopt;
  const auto y = xAndY ? parsed<int>(xAndY->second) : std::nullopt;
  if (!size || !x || !y || *x < 0 || *y < 0) refuse(option, expected, text);
  return {*x, *y, *size};
}

ToneCurve toneFrom(const std::string& text, const std::string& option) {
  std::vector<std::string_view> names;
  for (const ToneCurve curve : allToneCurves()) names.emplace_back(nameOf(curve));
  const std::string chosen = choiceFrom(text, names, option);
  const auto at = std::find(names.begin(), names.end(), chosen) - names.begin();
  return allToneCurves()[static_cast<std::size_t>(at)];
}

std::optional<double> unitFrom(const std::string& text, const std::string& option) {
  if (text == "auto") return std::nullopt;
  const auto unit = parsed<double>(text);
  if (!unit || !(*unit >= 1e-9 && *unit <= 1e9))
    refuse(option, "the cd/m2 of a radiance of 1, from 1e-9 to 1e9, or 'auto'", text);
  return *unit;
}

std::optional<double> exposureFrom(const std::string& text, const std::string& option) {
  if (text == "auto") return std::nullopt;
  const auto stops = parsed<double>(text);
  if (!stops || !(std::abs(*stops) <= 60.0))
    refuse(option, "a number of stops from -60 to 60, or 'auto'", text);
  return *stops;
}

ToneOptions toneOptionsFrom(const std::string& tone, const std::string& exposure, const std::string& unit,
                            const OcioOptions& ocio) {
  const ToneCurve otherwise = ocio.areGiven() ? ToneCurve::kOcio : ToneCurve::kNeutral;
  ToneOptions options{tone.empty() ? otherwise : toneFrom(tone, "--tone"),
                      exposureFrom(exposure, "--exposure"), unitFrom(unit, "--unit"), nullptr};
  if (options.candelasPerUnit && !modelsTheEye(options.curve)) {
    throw InputError("--unit: only the tones of the eye ask for it, '" + std::string(nameOf(options.curve)) +
                     "' was chosen");
  }
  if (ocio.areGiven() && options.curve != ToneCurve::kOcio) {
    throw InputError("--ocio: is the tone of a config (--tone ocio), '" + tone + "' was chosen");
  }
  if (options.candelasPerUnit && options.exposureEv) {
    throw InputError(
        "--unit, --exposure: expected one of them, found both: either says how bright the world is");
  }
  if (options.curve == ToneCurve::kOcio) options.view = viewFrom(ocio);
  return options;
}

std::string choiceFrom(const std::string& text, std::span<const std::string_view> choices,
                       const std::string& option) {
  if (std::find(choices.begin(), choices.end(), text) != choices.end()) return text;
  throw InputError(option, "unknown value '" + printable(text.substr(0, 80)) + "'; did you mean '" +
                               nearestName(text, choices) + "'?");
}

std::string choiceFrom(const std::string& text, std::initializer_list<std::string_view> choices,
                       const std::string& option) {
  return choiceFrom(text, std::span(choices.begin(), choices.size()), option);
}

}  // namespace promenade::app
