#include "src/app/displays.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "src/app/display_presets.h"
#include "src/app/printable.h"
#include "src/core/errors.h"
#include "src/core/nearest_name.h"
#include "src/io/text_file.h"

namespace promenade::app {
namespace {

using Json = nlohmann::json;
constexpr std::array<std::string_view, 10> kKeys = {"about",       "name",    "resolution", "diagonal",
                                                    "distance",    "peak",    "black",      "ambient",
                                                    "reflectance", "transfer"};

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

}  // namespace

DisplayModel displayFromJson(const std::string& text, const std::string& fileName) {
  const Json root = Json::parse(text, nullptr, false);
  if (!root.is_object()) throw InputError(fileName, "expected a JSON object that describes a display");
  for (const auto& [key, value] : root.items()) {
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) {
      throw InputError(
          fileName, "unknown key '" + printable(key) + "'; did you mean '" + nearestName(key, kKeys) + "'?");
    }
  }
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
  if (root.contains("transfer")) {
    const std::string name = root["transfer"].is_string() ? root["transfer"].get<std::string>() : "";
    if (name != "srgb" && name != "gamma2.2" && name != "linear") {
      throw InputError(fileName, "transfer: expected 'srgb', 'gamma2.2' or 'linear'");
    }
    display.transfer = name == "srgb"     ? TransferFunction::kSrgb
                       : name == "linear" ? TransferFunction::kLinear
                                          : TransferFunction::kGamma22;
  }
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
    char line[256];
    std::snprintf(line, sizeof(line), "%-8s  %dx%d, %.1f pixels/degree, %g to %g cd/m2, %g lux: %s\n",
                  d.name.c_str(), d.resolution.width, d.resolution.height, d.pixelsPerDegree(),
                  d.blackLuminance, d.peakLuminance, d.ambientIlluminance,
                  Json::parse(preset.json).value("about", "").c_str());
    list += line;
  }
  return list + "A display of your own: --display FILE.json (docs/formats.md says what is in it)\n";
}

}  // namespace promenade::app
