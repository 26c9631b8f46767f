#include "src/io/palette.h"

#include <algorithm>

namespace promenade::io {
namespace {

constexpr int kRedLevels = 6;
constexpr int kGreenLevels = 7;
constexpr int kBlueLevels = 6;

// Bayer's threshold of a pixel in (0, 1): the bits of x^y and y interleaved, coarse ones last.
float threshold(int x, int y) {
  int value = 0;
  for (int bit = 0; bit < 3; ++bit) {
    const int xBit = (x >> bit) & 1;
    const int yBit = (y >> bit) & 1;
    value |= (((xBit ^ yBit) << 1) | yBit) << (2 * (2 - bit));
  }
  return (static_cast<float>(value) + 0.5f) / 64.0f;
}

int level(float code, int levels, float dither) {
  const float scaled = (code > 0.0f ? std::min(code, 1.0f) : 0.0f) * static_cast<float>(levels - 1);
  return std::min(static_cast<int>(scaled + dither), levels - 1);
}

}  // namespace

std::array<std::uint32_t, 256> fixedPalette() {
  std::array<std::uint32_t, 256> palette;
  palette.fill(0xff000000U);
  std::size_t index = 0;
  const auto byte = [](int step, int levels) {
    return static_cast<std::uint32_t>((step * 510 / (levels - 1) + 1) / 2);
  };
  for (int r = 0; r < kRedLevels; ++r) {
    for (int g = 0; g < kGreenLevels; ++g) {
      for (int b = 0; b < kBlueLevels; ++b) {
        palette[index++] =
            0xff000000U | byte(r, kRedLevels) << 16 | byte(g, kGreenLevels) << 8 | byte(b, kBlueLevels);
      }
    }
  }
  return palette;
}

std::vector<std::uint8_t> toPalette(const EncodedMap& image) {
  std::vector<std::uint8_t> indices;
  indices.reserve(image.size().area());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const Rgb code = image(x, y);
      const float dither = threshold(x, y);
      const int r = level(code.r, kRedLevels, dither);
      const int g = level(code.g, kGreenLevels, dither);
      const int b = level(code.b, kBlueLevels, dither);
      indices.push_back(static_cast<std::uint8_t>((r * kGreenLevels + g) * kBlueLevels + b));
    }
  }
  return indices;
}

}  // namespace promenade::io
