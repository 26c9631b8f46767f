#pragma once
// Procedural pictures: noise, random numbers, and an 8-bit canvas.

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace promenade::hall {

/// An 8-bit RGB image, row-major, origin top left.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Colours here are encoded (sRGB code values in [0, 1]) or plain numbers, as the picture's use wants.
using Color = glm::dvec3;

/// Evaluates `color(u, v)` at every pixel centre, u right and v down in [0, 1]; values are clamped.
[[nodiscard]] Picture paint(int width, int height, const std::function<Color(double u, double v)>& color);

/// A tangent-space normal map (+Y up) of the height field `heightMetres(u, v)`, periodic in [0, 1), whose
/// texture covers `metres` in both directions.
[[nodiscard]] Picture normalMap(int size, double metres,
                                const std::function<double(double u, double v)>& heightMetres);

/// SplitMix64: small, well mixed, the same everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  [[nodiscard]] double uniform();  ///< in [0, 1)
  [[nodiscard]] double uniform(double low, double high) { return low + (high - low) * uniform(); }

 private:
  std::uint64_t state_;
};

/// A number in [0, 1) for a lattice cell.
[[nodiscard]] double cellNoise(int x, int y, int seed);
/// Gradient noise in about [-1, 1] with periods `periodX`, `periodY` (whole numbers >= 1) in x and y.
[[nodiscard]] double gradientNoise(double x, double y, int periodX, int periodY, int seed);
/// Octaves of it, amplitude halving, over (u, v) in [0, 1): `cells` lattice cells across at first; about [-1,
/// 1].
[[nodiscard]] double fractalNoise(double u, double v, int cells, int octaves, int seed);

[[nodiscard]] double smoothStep(double from, double to, double x);
[[nodiscard]] Color mix(const Color& a, const Color& b, double t);

}  // namespace promenade::hall
