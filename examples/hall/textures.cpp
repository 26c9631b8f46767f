#include "examples/hall/textures.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace promenade::hall {
namespace {

constexpr int kTiles = 4;  // across one period

double fraction(double x) {
  return x - std::floor(x);
}

/// Distance from the nearest joint, in tiles: 0 on it, 0.5 in the middle of a tile.
double distanceFromJoint(double u, double v) {
  const double x = fraction(u * kTiles), y = fraction(v * kTiles);
  return std::min(std::min(x, 1.0 - x), std::min(y, 1.0 - y));
}

constexpr double kJoint = 0.007;  // half the width of a joint, in tiles

/// Thin lines where a warped noise crosses zero: 1 on a vein, falling off with distance.
double veins(double u, double v, int cells, double sharpness, int seed) {
  const double warpU = 0.12 * fractalNoise(u, v, 3, 4, seed + 50),
               warpV = 0.12 * fractalNoise(u, v, 3, 4, seed + 70);
  return std::exp(-sharpness * std::abs(fractalNoise(u + warpU, v + warpV, cells, 4, seed)));
}

}  // namespace

Picture stoneTiles() {
  const Color light(0.80, 0.755, 0.67), dark(0.47, 0.40, 0.345), joint(0.42, 0.38, 0.33);
  return paint(768, 768, [&](double u, double v) {
    const int column = static_cast<int>(u * kTiles), row = static_cast<int>(v * kTiles);
    const bool isDark = (column + row) % 2 == 1;
    // Each tile is cut from another place of the quarry.
    const double shiftU = cellNoise(column, row, 1), shiftV = cellNoise(column, row, 2);
    const double clouds = fractalNoise(u + shiftU, v + shiftV, 6, 3, 11);
    const double vein = veins(u + shiftU, v + shiftV, 4, 16.0, 23);
    Color c = isDark ? dark : light;
    c *= 1.0 + 0.10 * (cellNoise(column, row, 3) - 0.5) + 0.07 * clouds;
    c = mix(c, isDark ? Color(0.62, 0.55, 0.48) : Color(0.67, 0.61, 0.53), 0.45 * vein);
    return mix(joint, c, smoothStep(kJoint, 1.8 * kJoint, distanceFromJoint(u, v)));
  });
}

Picture stoneTilesNormals() {
  return normalMap(512, kTilesMetres, [](double u, double v) {
    const double edge = smoothStep(kJoint, 5.0 * kJoint, distanceFromJoint(u, v));
    const int column = static_cast<int>(std::floor(fraction(u) * kTiles));
    const int row = static_cast<int>(std::floor(fraction(v) * kTiles));
    // Every tile lies a little askew: two millimetres over its width at most.
    const double lean = 0.002 * ((cellNoise(column, row, 5) - 0.5) * (fraction(u * kTiles) - 0.5) +
                                 (cellNoise(column, row, 6) - 0.5) * (fraction(v * kTiles) - 0.5));
    return 0.0012 * edge + lean;
  });
}

Picture paleMarble() {
  return paint(512, 512, [](double u, double v) {
    const double clouds = fractalNoise(u, v, 3, 4, 31);
    const double vein = veins(u, v, 3, 12.0, 37), fine = veins(u, v, 7, 18.0, 41);
    return Color(0.85, 0.82, 0.77) * (1.0 + 0.035 * clouds) -
           Color(0.16, 0.15, 0.13) * (0.7 * vein + 0.3 * fine);
  });
}

Picture darkMarble() {
  return paint(512, 512, [](double u, double v) {
    const double clouds = fractalNoise(u, v, 4, 5, 61);
    const double vein = veins(u, v, 3, 26.0, 67), fine = veins(u, v, 6, 40.0, 73);
    const Color ground = mix(Color(0.10, 0.17, 0.15), Color(0.20, 0.30, 0.26), 0.5 + 0.7 * clouds);
    return mix(ground, Color(0.70, 0.74, 0.68), std::clamp(0.75 * vein + 0.35 * fine, 0.0, 1.0));
  });
}

Picture plaster() {
  return paint(384, 384, [](double u, double v) {
    const double clouds = fractalNoise(u, v, 3, 4, 83);
    return Color(0.83, 0.795, 0.73) * (1.0 + 0.03 * clouds);
  });
}

Picture plasterNormals() {
  return normalMap(384, kPlasterMetres, [](double u, double v) {
    return 0.0022 * fractalNoise(u, v, 10, 3, 97);  // the trowel's marks
  });
}

Picture damask() {
  const Color ground(0.55, 0.21, 0.17), figure(0.64, 0.28, 0.21);
  return paint(256, 256, [&](double u, double v) {
    // A half-drop repeat: the ornament stands at the centre and at the corners.
    double ornament = 0.0;
    for (int k = 0; k < 5; ++k) {
      const double cx = k == 4 ? 0.5 : k % 2, cy = k == 4 ? 0.5 : k / 2;
      const double x = (u - cx) * 2.0, y = (v - cy) * 1.6;
      const double r = std::hypot(x, y), angle = std::atan2(x, -y);
      const double petals = 0.30 + 0.16 * std::cos(6.0 * angle) + 0.10 * std::cos(2.0 * angle);
      ornament = std::max(ornament,
                          smoothStep(0.03, -0.03, r - petals) * smoothStep(-0.03, 0.03, r - 0.45 * petals));
      ornament = std::max(ornament, smoothStep(0.02, -0.02, r - 0.09));
    }
    const double lattice =
        std::abs(std::cos(2.0 * glm::pi<double>() * (u + v)) * std::cos(2.0 * glm::pi<double>() * (u - v)));
    ornament = std::max(ornament, 0.6 * smoothStep(0.10, 0.04, lattice));
    const double weave =
        0.02 * std::sin(2.0 * glm::pi<double>() * 64.0 * v) * std::sin(2.0 * glm::pi<double>() * 64.0 * u);
    return mix(ground, figure, ornament) * (1.0 + weave);
  });
}

Picture wood() {
  return paint(384, 384, [](double u, double v) {
    // Growth rings are nearly straight along the grain, which runs along v.
    const double bend = 0.06 * gradientNoise(u * 3.0, v * 1.0, 3, 1, 101) +
                        0.015 * gradientNoise(u * 8.0, v * 4.0, 8, 4, 103);
    const double rings = fraction((u + bend) * 36.0);
    const double ring = smoothStep(0.0, 0.75, rings) * smoothStep(1.0, 0.9, rings);
    const double fibre = gradientNoise(u * 96.0, v * 4.0, 96, 4, 107);
    return mix(Color(0.47, 0.28, 0.16), Color(0.38, 0.22, 0.125), ring) * (1.0 + 0.07 * fibre);
  });
}

Picture glazedPorcelain() {
  const Color white(0.90, 0.92, 0.93), blue(0.10, 0.20, 0.55);
  return paint(512, 384, [&](double u, double v) {
    double ink = 0.0;
    // Bands at the foot and the shoulder, and branches of leaves between them.
    for (const double band : {0.05, 0.10, 0.72, 0.77}) {
      ink = std::max(ink, smoothStep(0.012, 0.006, std::abs(v - band)));
    }
    const double zigzag = std::abs(fraction(u * 24.0) - 0.5) * 0.09;
    ink = std::max(ink, smoothStep(0.012, 0.004, std::abs(v - 0.725 - zigzag)) * 0.9);
    for (int branch = 0; branch < 6; ++branch) {
      const double phase = branch / 6.0;
      const double stem = fraction(u - phase - 0.05 * std::sin(9.0 * v) + 0.5) - 0.5;
      if (v > 0.14 && v < 0.68) {
        ink = std::max(ink, smoothStep(0.006, 0.003, std::abs(stem)));
        const double along = fraction(v * 9.0) - 0.5,
                     side = (std::floor(v * 9.0) - 2.0 * std::floor(v * 4.5)) * 2.0 - 1.0;
        const double leaf = std::hypot((stem * side - 0.030) / 0.028, along / 0.42 - stem * side * 8.0);
        ink = std::max(ink, 0.85 * smoothStep(1.0, 0.85, leaf));
      }
    }
    return mix(white, blue, ink * (0.85 + 0.15 * fractalNoise(u, v, 12, 2, 113)));
  });
}

}  // namespace promenade::hall
