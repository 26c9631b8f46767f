#include "src/io/yuv420.h"

#include <algorithm>
#include <cmath>

namespace promenade::io {
namespace {

constexpr float kRed = 0.2126f;
constexpr float kGreen = 0.7152f;
constexpr float kBlue = 0.0722f;

float cleaned(float code) {
  return code > 0.0f ? std::min(code, 1.0f) : 0.0f;
}

struct YCbCr {
  float y;   // 0 to 1
  float cb;  // -0.5 to 0.5
  float cr;
};

YCbCr convert(const Rgb& code) {
  const float r = cleaned(code.r);
  const float g = cleaned(code.g);
  const float b = cleaned(code.b);
  const float y = kRed * r + kGreen * g + kBlue * b;
  return {y, (b - y) / (2.0f * (1.0f - kBlue)), (r - y) / (2.0f * (1.0f - kRed))};
}

std::uint8_t lumaByte(float y) {
  return static_cast<std::uint8_t>(219.0f * y + 16.5f);
}
std::uint8_t chromaByte(float c) {
  return static_cast<std::uint8_t>(224.0f * c + 128.5f);
}

}  // namespace

Size evenSize(Size size) {
  return {size.width + size.width % 2, size.height + size.height % 2};
}

Yuv420 toYuv420(const EncodedMap& image) {
  Yuv420 out;
  out.size = evenSize(image.size());
  const int width = out.size.width;
  const int height = out.size.height;
  out.y.reserve(out.size.area());
  out.cb.reserve(out.size.area() / 4);
  out.cr.reserve(out.size.area() / 4);

  std::vector<YCbCr> pair(static_cast<std::size_t>(width) * 2);  // two rows, converted
  const auto pixel = [&](int x, int row) -> const YCbCr& {
    return pair[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(std::clamp(x, 0, width - 1))];
  };
  for (int y = 0; y < height; y += 2) {
    for (int row = 0; row < 2; ++row) {
      const int sourceY = std::min(y + row, image.height() - 1);
      for (int x = 0; x < width; ++x) {
        const YCbCr value = convert(image(std::min(x, image.width() - 1), sourceY));
        pair[static_cast<std::size_t>(row * width + x)] = value;
        out.y.push_back(lumaByte(value.y));
      }
    }
    for (int x = 0; x < width; x += 2) {
      float cb = 0.0f;
      float cr = 0.0f;
      for (int row = 0; row < 2; ++row) {
        cb += pixel(x - 1, row).cb + 2.0f * pixel(x, row).cb + pixel(x + 1, row).cb;
        cr += pixel(x - 1, row).cr + 2.0f * pixel(x, row).cr + pixel(x + 1, row).cr;
      }
      out.cb.push_back(chromaByte(cb / 8.0f));
      out.cr.push_back(chromaByte(cr / 8.0f));
    }
  }
  return out;
}

}  // namespace promenade::io
