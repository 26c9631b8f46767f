#include "tests/e2e/exr_files.h"

#include <OpenImageIO/imageio.h>

#include <cmath>
#include <numbers>

namespace promenade::e2e {

void writeExr(const std::string& file, int width, int height,
              const std::vector<std::pair<std::string, Value>>& channels) {
  std::vector<float> pixels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (const auto& [name, value] : channels) pixels.push_back(static_cast<float>(value(x, y)));
    }
  }
  OIIO::ImageSpec spec(width, height, static_cast<int>(channels.size()), OIIO::TypeDesc::FLOAT);
  spec.channelnames.clear();
  for (const auto& [name, value] : channels) spec.channelnames.push_back(name);
  const auto out = OIIO::ImageOutput::create(file);
  ASSERT_TRUE(out && out->open(file, spec));
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()));
  ASSERT_TRUE(out->close());
}

void writeLuminance(const std::string& file, int width, int height, const Value& value) {
  writeExr(file, width, height, {{"Y", value}});
}

Value grating(double contrast, double cycles) {
  return [=](int x, int) {
    return 50.0 * (1.0 + contrast * std::cos(2.0 * std::numbers::pi * cycles * (x + 0.5) / 128.0));
  };
}

Value constant(double value) {
  return [=](int, int) { return value; };
}

void Compare::writeGrating(double contrast) {
  writeLuminance(at("reference.exr"), 128, 128, constant(50.0));
  writeLuminance(at("test.exr"), 128, 128, grating(contrast, 8.0));
}

nlohmann::json Compare::compared(const std::vector<std::string>& options) {
  std::vector<std::string> arguments = {
      "compare", at("test.exr"), at("reference.exr"), "--absolute", "--ppd", "32", "--json", "--quiet"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Outcome outcome = run(arguments);
  expectDone(outcome);
  return nlohmann::json::parse(outcome.out, nullptr, false);
}

}  // namespace promenade::e2e
