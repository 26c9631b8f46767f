#include "src/app/displays.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <system_error>
#include <vector>

#include "src/app/display_presets.h"
#include "src/app/formatted.h"
#include "src/app/printable.h"
#include "src/core/errors.h"
#include "src/core/nearest_name.h"
#include "src/io/text_file.h"

namespace promenade::app {
namespace {

using Json = nlohmann::json;
constexpr std::array<std::string_view, 12> kKeys = {"about",       "name",     "resolution", "diagonal",
                                                    "distance",    "peak",     "black",      "ambient",
                                                    "reflectance", "transfer", "primaries",  "signal"};
constexpr std::array<std::string_view, 4> kLights = {"red", "green", "blue", "white"};

void requireKnownKeys(const Json& object, std::span<const std::string_view> known,
                      const std::string& fileName) {
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      throw InputError(
          fileName, "unknown key '" + printable(key) + "'; did you mean '" + nearestName(key, known) + "'?");
    }
  }
}

std::string textIn(const Json& root, const char* key, const std::string& otherwise) {
  if (!root.contains(key)) return otherwise;
  return root[key].is_string() ? root[key].get<std::string>() : "";
}

double numberIn(const Json& root, const char* key, double otherwise, double low, double high,
                const std::string& fileName) {
  if (!root.contains(key)) return otherwise;
  const double value = root[key].is_number() ? root[key].get<double>() : -1.0;
  if (!(value >= low && value <= high)) {
    throw InputError(fileName, std::string(key) + ": expected a number from " + Json(low).dump() + " to " +
                                   Json(high).dump());
  }
  return value;
}

int sideIn(const Json& value, const std::string& fileName) {
  const double side = value.is_number() ? value.get<double>() : 0.0;
  if (!(side >= 1.0 && side <= 65536.0)) {
    throw InputError(fileName, "resolution: expected two whole numbers from 1 to 65536");
  }
  return static_cast<int>(side);
}

void readTransfer(DisplayModel& display, const std::string& name, const std::string& fileName) {
  if (name == "srgb" || name == "linear") {
    display.transfer = name == "srgb" ? TransferFunction::kSrgb : TransferFunction::kLinear;
    return;
  }
  constexpr std::string_view kGamma = "gamma";
  double gamma = 0.0;
  if (name.starts_with(kGamma)) {
    const char* end = name.data() + name.size();
    const auto parsed = std::from_chars(name.data() + kGamma.size(), end, gamma);
    if (parsed.ec != std::errc() || parsed.ptr != end) gamma = 0.0;
  }
  if (!(gamma >= 1.0 && gamma <= 4.0)) {
    throw InputError(fileName,
                     "transfer: expected 'srgb', 'linear' or 'gamma2.2', with any gamma from 1 to 4");
  }
  display.transfer = TransferFunction::kGamma;
  display.gamma = gamma;
}

glm::dvec2 chromaticityIn(const Json& lights, std::string_view light, const std::string& fileName) {
  const Json& pair = lights.at(std::string(light));
  if (!pair.is_array() || pair.size() != 2 || !pair[0].is_number() || !pair[1].is_number()) {
    throw InputError(fileName, "primaries." + std::string(light) + ": expected a chromaticity [x, y]");
  }
  return {pair[0].get<double>(), pair[1].get<double>()};
}

Primaries primariesIn(const Json& lights, const std::string& fileName) {
  if (!lights.is_object()) {
    throw InputError(fileName, "primaries: expected an object with red, green, blue and white");
  }
  requireKnownKeys(lights, kLights, fileName + ": primaries");
  for (const std::string_view light : kLights) {
    if (!lights.contains(light)) throw InputError(fileName, "primaries: there is no " + std::string(light));
  }
  const Primaries primaries{
      chromaticityIn(lights, "red", fileName), chromaticityIn(lights, "green", fileName),
      chromaticityIn(lights, "blue", fileName), chromaticityIn(lights, "white", fileName)};
  if (!arePossible(primaries)) {
    throw InputError(
        fileName,
        "primaries: expected red, green and blue of a triangle with white inside of it, each with "
        "x >= 0, y > 0, x + y <= 1");
  }
  return primaries;
}

}  // namespace

DisplayModel displayFromJson(const std::string& text, const std::string& fileName) {
  const Json root = Json::parse(text, nullptr, false);
  if (!root.is_object()) throw InputError(fileName, "expected a JSON object that describes a display");
  requireKnownKeys(root, kKeys, fileName);
  DisplayModel display;
  display.name =
      root.contains("name") && root["name"].is_string() ? root["name"].get<std::string>() : fileName;
  if (root.contains("resolution")) {
    const Json& sides = root["resolution"];
    if (!sides.is_array() || sides.size() != 2)
      throw InputError(fileName, "resolution: expected [width, height]");
    display.resolution = {sideIn(sides[0], fileName), sideIn(sides[1], fileName)};
  }
  display.diagonalMetres = numberIn(root, "diagonal", display.diagonalMetres, 0.01, 1000.0, fileName);
  display.viewingDistanceMetres =
      numberIn(root, "distance", display.viewingDistanceMetres, 0.01, 1000.0, fileName);
  display.peakLuminance = numberIn(root, "peak", display.peakLuminance, 0.1, 1e5, fileName);
  display.blackLuminance = numberIn(root, "black", display.blackLuminance, 1e-6, 1e4, fileName);
  display.ambientIlluminance = numberIn(root, "ambient", display.ambientIlluminance, 0.0, 1e6, fileName);
  display.screenReflectance = numberIn(root, "reflectance", display.screenReflectance, 0.0, 1.0, fileName);
  if (display.blackLuminance >= display.peakLuminance) {
    throw InputError(fileName, "black: expected less than the peak luminance");
  }
  readTransfer(display, textIn(root, "transfer", "srgb"), fileName);
  if (root.contains("primaries")) display.primaries = primariesIn(root["primaries"], fileName);
  const std::string signal = textIn(root, "signal", "srgb");
  if (signal != "srgb" && signal != "native") {
    throw InputError(fileName, "signal: expected 'srgb' or 'native'");
  }
  display.signal = signal == "srgb" ? Signal::kSrgb : Signal::kNative;
  return display;
}

DisplayModel displayNamed(const std::string& nameOrFile) {
  std::vector<std::string> names;
  for (const DisplayPreset& preset : displayPresets()) {
    const DisplayModel display = displayFromJson(std::string(preset.json), std::string(preset.fileName));
    if (display.name == nameOrFile) return display;
    names.push_back(display.name);
  }
  if (nameOrFile.ends_with(".json") || std::filesystem::is_regular_file(nameOrFile)) {
    return displayFromJson(io::readTextFile(nameOrFile), nameOrFile);
  }
  const std::vector<std::string_view> known(names.begin(), names.end());
  throw InputError("--display: neither a preset nor a file: '" + printable(nameOrFile) + "'; did you mean '" +
                   nearestName(nameOrFile, known) + "'? (--display ? lists them)");
}

std::string displayNames() {
  std::string names;
  for (const DisplayPreset& preset : displayPresets()) {
    if (!names.empty()) names += '|';
    names += displayFromJson(std::string(preset.json), std::string(preset.fileName)).name;
  }
  return names;
}

std::string displayList() {
  std::string list;
  for (const DisplayPreset& preset : displayPresets()) {
    const DisplayModel d = displayFromJson(std::string(preset.json), std::string(preset.fileName));
    list +=
        formatted("%-8s  %dx%d, %.1f pixels/degree, %g to %g cd/m2, %g lux: %s\n", d.name.c_str(),
                  d.resolution.width, d.resolution.height, d.pixelsPerDegree(), d.blackLuminance,
                  d.peakLuminance, d.ambientIlluminance, Json::parse(preset.json).value("about", "").c_str());
  }
  return list + "A display of your own: --display FILE.json (docs/formats.md says what is in it)\n";
}

}  // namespace promenade::app
