#include "examples/hall/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace promenade::hall {
namespace {

std::uint64_t scramble(std::uint64_t z) {
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31U);
}

int wrapped(int i, int period) {
  return ((i % period) + period) % period;
}

std::uint8_t byte(double value) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}

/// Directions all around, looked up because noise asks for millions of them.
const std::array<glm::dvec2, 256>& gradients() {
  static const std::array<glm::dvec2, 256> table = [] {
    std::array<glm::dvec2, 256> directions;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const double angle =
          2.0 * glm::pi<double>() * static_cast<double>(i) / static_cast<double>(directions.size());
      directions[i] = {std::cos(angle), std::sin(angle)};
    }
    return directions;
  }();
  return table;
}

double fade(double t) {
  return t * t * t * (t * (6.0 * t - 15.0) + 10.0);
}

}  // namespace

Picture paint(int width, int height, const std::function<Color(double, double)>& color) {
  Picture picture{width, height, {}};
  picture.rgb.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Color c = color((x + 0.5) / width, (y + 0.5) / height);
      picture.rgb.insert(picture.rgb.end(), {byte(c.x), byte(c.y), byte(c.z)});
    }
  }
  return picture;
}

Picture normalMap(int size, double metres, const std::function<double(double, double)>& heightMetres) {
  const double step = 1.0 / size;
  return paint(size, size, [&](double u, double v) {
    const double du = (heightMetres(u + 0.5 * step, v) - heightMetres(u - 0.5 * step, v)) / (step * metres);
    const double dv = (heightMetres(u, v + 0.5 * step) - heightMetres(u, v - 0.5 * step)) / (step * metres);
    // v runs down the image and +Y of the tangent space up.
    const glm::dvec3 n = glm::normalize(glm::dvec3(-du, dv, 1.0));
    return 0.5 * n + 0.5;
  });
}

double Random::uniform() {
  state_ += 0x9e3779b97f4a7c15ULL;
  return static_cast<double>(scramble(state_) >> 11U) * 0x1.0p-53;
}

double cellNoise(int x, int y, int seed) {
  const std::uint64_t key =
      (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32U) ^
      static_cast<std::uint64_t>(static_cast<std::uint32_t>(y)) ^
      (static_cast<std::uint64_t>(static_cast<std::uint32_t>(seed)) * 0x9e3779b97f4a7c15ULL);
  return static_cast<double>(scramble(scramble(key)) >> 11U) * 0x1.0p-53;
}

double gradientNoise(double x, double y, int periodX, int periodY, int seed) {
  const double x0 = std::floor(x), y0 = std::floor(y);
  const double fx = x - x0, fy = y - y0;
  const auto corner = [&](int i, int j) {
    const int cx = wrapped(static_cast<int>(x0) + i, periodX),
              cy = wrapped(static_cast<int>(y0) + j, periodY);
    const auto which = static_cast<std::size_t>(256.0 * cellNoise(cx, cy, seed));
    return glm::dot(gradients()[which], glm::dvec2(fx - i, fy - j));
  };
  const double top = std::lerp(corner(0, 0), corner(1, 0), fade(fx));
  const double bottom = std::lerp(corner(0, 1), corner(1, 1), fade(fx));
  return 1.414 * std::lerp(top, bottom, fade(fy));
}

double fractalNoise(double u, double v, int cells, int octaves, int seed) {
  double sum = 0.0, amplitude = 0.6;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += amplitude * gradientNoise(u * cells, v * cells, cells, cells, seed + octave);
    amplitude *= 0.5;
    cells *= 2;
  }
  return sum;
}

double smoothStep(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

Color mix(const Color& a, const Color& b, double t) {
  return a + (b - a) * t;
}

}  // namespace promenade::hall
