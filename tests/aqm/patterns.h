#pragma once
// Frames made from formulas, for the tests of the metric.

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "aqm/metric.h"

namespace promenade::aqm::tests {

using std::numbers::pi;

/// `luminance` (cd/m2) and `velocity` (degrees per second) of pixel (x, y).
inline LuminanceMap frameOf(Size size, const std::function<double(int, int)>& luminance) {
  LuminanceMap map(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      map(x, y) = static_cast<float>(luminance(x, y));
    }
  }
  return map;
}

inline VelocityMap velocityOf(Size size, const std::function<glm::dvec2(int, int)>& velocity) {
  VelocityMap map(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      map(x, y) = glm::vec2(velocity(x, y));
    }
  }
  return map;
}

/// cos of a vertical-bar grating with 8 periods in 128 pixels (2 cycles per degree at 32 pixels per degree).
inline double bars(int x) {
  return std::cos(2.0 * pi * 8.0 * (x + 0.5) / 128.0);
}

/// An image without symmetries and, in `second`, the same with a faint blob; the motion grows from left to
/// right.
struct BlobScene {
  Size size{192, 128};
  LuminanceMap plain = frameOf(size, [](int x, int y) {
    return 40.0 + 20.0 * std::sin(2.0 * pi * x / 37.0) * std::cos(2.0 * pi * y / 29.0);
  });
  LuminanceMap withBlob = frameOf(size, [](int x, int y) {
    const double base = 40.0 + 20.0 * std::sin(2.0 * pi * x / 37.0) * std::cos(2.0 * pi * y / 29.0);
    return base * (1.0 + 0.05 * std::exp(-((x - 120.0) * (x - 120.0) + (y - 50.0) * (y - 50.0)) / 200.0));
  });
  VelocityMap velocity = velocityOf(size, [](int x, int) { return glm::dvec2(12.0 * x / 191.0, -4.0); });
};

/// Grey noise around 50 cd/m2, uniformly distributed over `contrast` times that.
inline LuminanceMap noise(Size size, unsigned seed, double contrast) {
  std::mt19937 random(seed);
  return frameOf(size, [&](int, int) {
    return 50.0 * (1.0 + contrast * (static_cast<double>(random()) / 4294967295.0 - 0.5));
  });
}

/// The yardstick: fast_test.cpp holds the fast execution against it.
inline Settings plainly(double ppd) {
  Settings settings = aqm(ppd);
  settings.execution = Execution::kPlain;
  return settings;
}

template <class Map>
double largest(const Map& map) {
  double result = 0.0;
  for (const float value : map.pixels()) {
    result = std::max(result, static_cast<double>(value));
  }
  return result;
}

template <class Map>
double mean(const Map& map) {
  double sum = 0.0;
  for (const float value : map.pixels()) {
    sum += static_cast<double>(value);
  }
  return sum / static_cast<double>(map.size().area());
}

}  // namespace promenade::aqm::tests
