#include "src/io/ocio.h"

#include <OpenColorIO/OpenColorIO.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <vector>

#include "src/core/errors.h"
#include "src/core/primaries.h"
#include "src/io/file_error.h"

namespace promenade::io {
namespace {

namespace OCIO = OCIO_NAMESPACE;

// Linear Rec.709 in the configs of the ACES working group (the present ones, then 1.x), of Blender and of
// OpenImageIO.
constexpr std::array kUsualNames = {"Linear Rec.709 (sRGB)",   "lin_rec709_srgb", "lin_rec709", "lin_srgb",
                                    "Utility - Linear - sRGB", "Linear Rec.709"};
constexpr const char* kAcesInterchange = "aces_interchange";
constexpr const char* kSceneLinear = "scene_linear";

std::string oneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (text.ends_with(' ')) text.pop_back();
  return text;
}

std::string quoted(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "'" : ", '") + name + "'";
  return list;
}

std::vector<std::string> displaysOf(const OCIO::Config& config) {
  std::vector<std::string> names;
  for (int i = 0; i < config.getNumDisplays(); ++i) names.emplace_back(config.getDisplay(i));
  return names;
}

std::vector<std::string> viewsOf(const OCIO::Config& config, const std::string& display) {
  std::vector<std::string> names;
  for (int i = 0; i < config.getNumViews(display.c_str()); ++i)
    names.emplace_back(config.getView(display.c_str(), i));
  return names;
}

std::vector<std::string> coloursOf(const OCIO::Config& config) {
  std::vector<std::string> names;
  for (int i = 0; i < config.getNumColorSpaces(); ++i) names.emplace_back(config.getColorSpaceNameByIndex(i));
  return names;
}

// The one that is asked for, else `otherwise`; if it is none of `names`, "FILE: WHATISNOT 'NAME'".
std::string chosen(const std::string& asked, const std::string& otherwise,
                   const std::vector<std::string>& names, const std::string& file,
                   const std::string& whatIsNot) {
  const std::string name = asked.empty() ? otherwise : asked;
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    throw InputError(file, whatIsNot + " '" + name + "'; expected one of " + quoted(names));
  }
  return name;
}

std::string inputOf(const OCIO::Config& config, const ColourViewRequest& request) {
  const auto has = [&](const char* name) { return config.getColorSpace(name) != nullptr; };
  if (!request.input.empty()) {
    if (has(request.input.c_str())) return request.input;
    throw InputError(request.config, "there is no colour space '" + request.input + "'; expected one of " +
                                         quoted(coloursOf(config)));
  }
  for (const char* name : kUsualNames) {
    if (has(name)) return name;
  }
  for (const char* role : {kAcesInterchange, kSceneLinear}) {
    if (config.hasRole(role)) return role;
  }
  throw InputError(request.config,
                   "there is no role scene_linear, and no colour space has a usual name of linear Rec.709; "
                   "expected --ocio-input and one of " +
                       quoted(coloursOf(config)));
}

// From linear Rec.709 to ACES2065-1, which is what the role aces_interchange is.
void appendAcesFromRec709(OCIO::GroupTransform& group) {
  const glm::dmat3 xyz = xyzFromRgb(Primaries{});
  std::array<double, 16> rows{};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      rows[static_cast<std::size_t>(4 * row + column)] = xyz[column][row];
  }
  rows[15] = 1.0;
  const auto matrix = OCIO::MatrixTransform::Create();
  matrix->setMatrix(rows.data());
  group.appendTransform(matrix);
  const auto aces = OCIO::BuiltinTransform::Create();
  aces->setStyle("UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD");
  aces->setDirection(OCIO::TRANSFORM_DIR_INVERSE);
  group.appendTransform(aces);
}

OCIO::ConstCPUProcessorRcPtr processorOf(const OCIO::Config& config, const ColourView& view) {
  const auto group = OCIO::GroupTransform::Create();
  if (view.input == kAcesInterchange) appendAcesFromRec709(*group);
  const auto shown = OCIO::DisplayViewTransform::Create();
  shown->setSrc(view.input.c_str());
  shown->setDisplay(view.display.c_str());
  shown->setView(view.view.c_str());
  group->appendTransform(shown);
  // Lossless: no approximate powers and logarithms.
  return config.getProcessor(group)->getOptimizedCPUProcessor(OCIO::OPTIMIZATION_LOSSLESS);
}

ColourView opened(const ColourViewRequest& request) {
  const std::string& file = request.config;
  const OCIO::ConstConfigRcPtr config = OCIO::Config::CreateFromFile(file.c_str());
  if (config->getNumDisplays() == 0) throw InputError(file, "the config has no displays");
  ColourView view;
  view.config = std::filesystem::absolute(file).lexically_normal().string();
  view.display =
      chosen(request.display, config->getDefaultDisplay(), displaysOf(*config), file, "there is no display");
  view.view = chosen(request.view, config->getDefaultView(view.display.c_str()),
                     viewsOf(*config, view.display), file, "the display '" + view.display + "' has no view");
  view.input = inputOf(*config, request);
  const OCIO::ConstCPUProcessorRcPtr processor = processorOf(*config, view);
  view.fingerprint = processor->getCacheID();
  view.codes = [processor](const Rgb& radiance) {
    Rgb codes = radiance;
    processor->applyRGB(&codes.x);
    return codes;
  };
  return view;
}

}  // namespace

ColourView openColourView(const ColourViewRequest& request) {
  requireRegularFile(request.config);
  // What is wrong leaves as an exception; the rest would be notices on standard error.
  OCIO::SetLoggingLevel(OCIO::LOGGING_LEVEL_NONE);
  try {
    return opened(request);
  } catch (const OCIO::Exception& error) {
    throw InputError(request.config, "OpenColorIO: " + oneLine(error.what()));
  }
}

}  // namespace promenade::io
