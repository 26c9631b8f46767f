#include "src/app/exposure.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "src/app/values.h"
#include "src/core/display.h"
#include "src/io/json.h"

namespace promenade::app {
namespace {

struct LogSum {
  double sum = 0.0;
  double count = 0.0;
};

// The same rule as walkthrough::automaticExposure: darker pixels than a ten-thousandth of the brightest count
// as that.
void addImage(LogSum& log, const RadianceMap& radiance) {
  double brightest = 0.0;
  for (const Rgb& value : radiance.pixels()) {
    const double l = static_cast<double>(luminance(value));
    if (std::isfinite(l)) brightest = std::max(brightest, l);
  }
  for (const Rgb& value : radiance.pixels()) {
    const double l = static_cast<double>(luminance(value));
    if (!std::isfinite(l)) continue;
    log.sum += std::log2(std::max({l, 1e-4 * brightest, 1e-30}));
    log.count += 1.0;
  }
}

}  // namespace

double exposureFor(std::span<const io::Sequence> sequences) {
  constexpr std::size_t kFrames = 7;
  constexpr double kMiddleGrey = 0.18;
  double sum = 0.0;
  double count = 0.0;
  for (const io::Sequence& sequence : sequences) {
    LogSum log;
    const std::size_t images = sequence.images.size();
    for (std::size_t k = 0; k < std::min(kFrames, images); ++k) {
      const std::size_t index = images <= kFrames ? k : k * (images - 1) / (kFrames - 1);
      const io::ImageFile image = io::readImage(sequence.images[index]);
      if (const auto* radiance = std::get_if<RadianceMap>(&image.colour)) addImage(log, *radiance);
    }
    sum += log.sum;
    count += log.count;
  }
  if (count == 0.0) return 0.0;
  return std::round(10.0 * std::clamp(std::log2(kMiddleGrey) - sum / count, -40.0, 40.0)) / 10.0;
}

std::optional<double> renderedExposure(const std::string& argument) {
  const std::filesystem::path report = std::filesystem::path(argument) / "report.json";
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
