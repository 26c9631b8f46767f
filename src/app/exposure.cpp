#include "src/app/exposure.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "src/app/values.h"
#include "src/core/display.h"
#include "src/io/json.h"
#include "src/walkthrough/walkthrough.h"

namespace promenade::app {
namespace {

// Mean luminances of about square parts, eight across (fewer where the image is smaller), as the renderer
// looks at its own frames.
void addParts(std::vector<double>& luminances, const RadianceMap& radiance) {
  const auto [width, height] = radiance.size();
  const int columns = std::min(8, width);
  const int rows = std::clamp(static_cast<int>(std::lround(double(columns) * height / width)), 1, height);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      double sum = 0.0;
      double count = 0.0;
      for (int y = height * row / rows; y < height * (row + 1) / rows; ++y) {
        for (int x = width * column / columns; x < width * (column + 1) / columns; ++x) {
          const double l = static_cast<double>(luminance(radiance(x, y)));
          if (!std::isfinite(l)) continue;
          sum += l;
          count += 1.0;
        }
      }
      if (count > 0.0) luminances.push_back(sum / count);
    }
  }
}

}  // namespace

double exposureFor(std::span<const io::Sequence> sequences) {
  constexpr std::size_t kFrames = 7;
  std::vector<double> luminances;
  for (const io::Sequence& sequence : sequences) {
    const std::size_t images = sequence.images.size();
    for (std::size_t k = 0; k < std::min(kFrames, images); ++k) {
      const std::size_t index = images <= kFrames ? k : k * (images - 1) / (kFrames - 1);
      const io::ImageFile image = io::readImage(sequence.images[index], sequence.layer);
      if (const auto* radiance = std::get_if<RadianceMap>(&image.colour)) addParts(luminances, *radiance);
    }
  }
  return walkthrough::exposureOf(std::move(luminances));
}

std::optional<double> renderedExposure(const std::string& argument) {
  std::filesystem::path folder(argument);
  if (!folder.has_filename()) folder = folder.parent_path();
  if (folder.filename() == "frames") folder = folder.parent_path();
  const std::filesystem::path report = folder / "report.json";
  if (!std::filesystem::is_regular_file(report)) return std::nullopt;
  const nlohmann::json root = io::readJson(report);
  if (!root.is_object() || !root.contains("job") || !root["job"].is_object()) return std::nullopt;
  const nlohmann::json& job = root["job"];
  if (!job.contains("exposure_ev") || !job["exposure_ev"].is_number()) return std::nullopt;
  return job["exposure_ev"].get<double>();
}

double chosenExposure(const std::string& option, std::span<const io::Sequence> sequences) {
  if (const auto stops = exposureFrom(option, "--exposure")) return *stops;
  std::optional<double> common;
  for (const io::Sequence& sequence : sequences) {
    const auto rendered = renderedExposure(sequence.argument);
    if (!rendered || (common && *common != *rendered)) return exposureFor(sequences);
    common = rendered;
  }
  return common ? *common : exposureFor(sequences);
}

}  // namespace promenade::app
