#pragma once
// OpenEXR files of channels that are functions of the pixel, and `promenade compare` of two of them.

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/e2e/tiny_scene.h"

namespace promenade::e2e {

using Value = std::function<double(int, int)>;

/// Floats.
void writeExr(const std::string& file, int width, int height,
              const std::vector<std::pair<std::string, Value>>& channels);

/// Luminance in cd/m2 as channel Y.
void writeLuminance(const std::string& file, int width, int height, const Value& value);

/// `cycles` over 128 columns, of contrast `contrast` around 50 cd/m2.
[[nodiscard]] Value grating(double contrast, double cycles);

[[nodiscard]] Value constant(double value);

class Compare : public InFolder {
 protected:
  /// test.exr: a grating of two cycles per degree at 32 pixels per degree; reference.exr: uniform.
  void writeGrating(double contrast);
  /// What `compare test.exr reference.exr --absolute --ppd 32` prints as JSON.
  nlohmann::json compared(const std::vector<std::string>& options);
};

}  // namespace promenade::e2e
