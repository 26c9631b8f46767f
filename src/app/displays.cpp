#include "src/app/displays.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "src/app/printable.h"
#include "src/core/errors.h"
#include "src/core/nearest_name.h"
#include "src/io/text_file.h"

namespace promenade::app {
namespace {

struct Preset {
  const char* about;
  DisplayModel display;
};

// Diagonal and distance in metres, luminances in cd/m2, ambient light in lux, reflectance of the screen.
std::vector<Preset> presets() {
  const auto srgb = TransferFunction::kSrgb;
  return {
      {"24 inch full HD desktop monitor at 60 cm in an office (the default)",
       {"fhd-24", {1920, 1080}, 0.61, 0.6, 250.0, 0.25, 50.0, 0.01, srgb}},
      {"21 inch CRT of 100 cd/m2 at 50 cm in a dark room (as in the papers of 1998-2000)",
       {"crt-100", {1280, 1024}, 0.508, 0.5, 100.0, 0.5, 0.0, 0.03, TransferFunction::kGamma22}},
      {"55 inch 4k television at 2 m in a living room",
       {"4k-tv", {3840, 2160}, 1.397, 2.0, 400.0, 0.1, 30.0, 0.005, srgb}},
      {"6.1 inch telephone at 35 cm", {"phone", {2532, 1170}, 0.155, 0.35, 600.0, 0.001, 250.0, 0.005, srgb}},
      {"14 inch full HD laptop at 50 cm",
       {"laptop", {1920, 1080}, 0.356, 0.5, 300.0, 0.3, 100.0, 0.01, srgb}},
  };
}

using Json = nlohmann::json;
constexpr std::array<std::string_view, 9> kKeys = {"name",  "resolution", "diagonal",    "distance", "peak",
                                                   "black", "ambient",    "reflectance", "transfer"};

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
  DisplayModel display = presets().front().display;
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
  const std::vector<Preset> known = presets();
  for (const Preset& preset : known) {
    if (preset.display.name == nameOrFile) return preset.display;
  }
  if (nameOrFile.ends_with(".json") || std::filesystem::is_regular_file(nameOrFile)) {
    return displayFromJson(io::readTextFile(nameOrFile), nameOrFile);
  }
  std::vector<std::string_view> names;
  for (const Preset& preset : known) names.push_back(preset.display.name);
  throw InputError("--display: neither a preset nor a file: '" + printable(nameOrFile) + "'; did you mean '" +
                   nearestName(nameOrFile, names) + "'? (--display ? lists them)");
}

std::string displayList() {
  std::string list;
  for (const Preset& preset : presets()) {
    const DisplayModel& d = preset.display;
    char line[256];
    std::snprintf(line, sizeof(line), "%-8s  %dx%d, %.1f pixels/degree, %g cd/m2: %s\n", d.name.c_str(),
                  d.resolution.width, d.resolution.height, d.pixelsPerDegree(), d.peakLuminance,
                  preset.about);
    list += line;
  }
  return list;
}

}  // namespace promenade::app
