#include "examples/hall/paintings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace promenade::hall {
namespace {

/// What a motif shows at (x, y), x right and y down in [0, 1]; `aspect` keeps circles round.
using Field = std::function<Color(double x, double y)>;

Color mountains(double x, double y) {
  Color c = mix(Color(0.35, 0.50, 0.72), Color(0.97, 0.74, 0.48), smoothStep(0.0, 0.55, y));
  c = mix(c, Color(1.0, 0.90, 0.66),
          std::exp(-60.0 * ((x - 0.66) * (x - 0.66) * 2.2 + (y - 0.36) * (y - 0.36))));
  c = mix(c, Color(0.95, 0.80, 0.70),
          0.5 * smoothStep(0.1, 0.6, fractalNoise(x * 0.5, y * 1.7, 4, 4, 201)) * smoothStep(0.45, 0.1, y));
  const std::array<Color, 4> ranges{Color(0.55, 0.52, 0.66), Color(0.38, 0.40, 0.56), Color(0.24, 0.31, 0.39),
                                    Color(0.15, 0.21, 0.17)};
  for (int k = 0; k < 4; ++k) {
    const double crest =
        0.40 + 0.11 * k - (0.16 - 0.025 * k) * fractalNoise(x * 0.45 + 0.13 * k, 0.2 * k, 5, 5, 211 + k);
    if (y > crest) {
      const double haze = smoothStep(0.0, 0.25, y - crest);
      c = mix(ranges[static_cast<std::size_t>(k)],
              ranges[static_cast<std::size_t>(k)] + Color(0.14, 0.12, 0.10), haze);
    }
  }
  if (y > 0.84) {  // a lake in front mirrors the sky
    const double ripple = fractalNoise(x * 0.3, y * 3.0, 8, 3, 223);
    c = mix(Color(0.30, 0.38, 0.48), Color(0.93, 0.70, 0.48),
            smoothStep(-0.2, 0.5, ripple) * std::exp(-9.0 * (x - 0.62) * (x - 0.62)));
  }
  return c;
}

Color sea(double x, double y) {
  const double horizon = 0.46;
  if (y < horizon) {
    const double clouds = smoothStep(-0.1, 0.5, fractalNoise(x * 0.6, y * 1.4, 4, 5, 231));
    const Color sky = mix(Color(0.30, 0.47, 0.68), Color(0.80, 0.86, 0.86), y / horizon);
    return mix(sky, Color(0.96, 0.93, 0.88) - 0.25 * y, 0.8 * clouds);
  }
  const double depth = (y - horizon) / (1.0 - horizon);
  const double waves = fractalNoise(x * 0.35, 0.9 * std::sqrt(depth), 9, 4, 241);
  Color c = mix(Color(0.16, 0.36, 0.46), Color(0.06, 0.20, 0.30), depth) + Color(0.10, 0.14, 0.13) * waves;
  c = mix(c, Color(0.92, 0.95, 0.93), smoothStep(0.38, 0.62, waves + 0.25 * depth));
  // A small boat with two sails.
  const double bx = (x - 0.36) / 0.10, by = (y - 0.50) / 0.16;
  if (by > -1.0 && by < -0.05 && bx > -0.75 * (by + 1.0) && bx < -0.04) c = Color(0.94, 0.90, 0.80);
  if (by > -0.85 && by < -0.05 && bx > 0.04 && bx < 0.55 * (by + 0.85)) c = Color(0.80, 0.42, 0.28);
  if (by >= -0.03 && by < 0.12 && std::abs(bx) < 0.75 - 1.5 * by) c = Color(0.22, 0.14, 0.10);
  return c;
}

Color birches(double x, double y) {
  Color c = mix(Color(0.86, 0.72, 0.36), Color(0.72, 0.40, 0.16),
                smoothStep(-0.4, 0.5, fractalNoise(x, y * 0.7, 6, 4, 251)));
  c = mix(c, Color(0.93, 0.90, 0.70),
          0.7 * std::exp(-14.0 * ((x - 0.5) * (x - 0.5) + (y - 0.3) * (y - 0.3))));
  if (y > 0.72)
    c = mix(Color(0.42, 0.33, 0.14), Color(0.72, 0.42, 0.16),
            smoothStep(-0.3, 0.4, fractalNoise(x, y, 14, 3, 257)));
  for (int k = 0; k < 9; ++k) {
    const double depth = cellNoise(k, 0, 263);
    const double width = 0.012 + 0.020 * depth, at = (k + 0.2 + 0.6 * cellNoise(k, 1, 263)) / 9.0;
    const double offset = x - at - 0.02 * gradientNoise(y * 3.0, k, 64, 64, 269);
    if (std::abs(offset) < width && y < 0.74 + 0.16 * depth) {
      const double shade = 0.5 - 0.5 * offset / width;
      c = mix(Color(0.48, 0.46, 0.46), Color(0.95, 0.93, 0.88), shade);
      if (gradientNoise(x * 20.0 + k, y * 34.0, 512, 512, 271) > 0.38) c = Color(0.16, 0.14, 0.13);
    }
  }
  return c;
}

Color colorFields(double x, double y) {
  const double soft = 0.012 * fractalNoise(x, y, 10, 4, 281);
  Color c(0.38, 0.07, 0.06);
  const auto block = [&](double top, double bottom, const Color& fill) {
    const double inside = std::min(std::min(x - 0.08, 0.92 - x), std::min(y - top, bottom - y)) + soft;
    c = mix(c, fill * (1.0 + 0.10 * fractalNoise(x * 0.6, y, 5, 4, 283)), smoothStep(0.0, 0.03, inside));
  };
  block(0.07, 0.44, Color(0.93, 0.55, 0.12));
  block(0.49, 0.61, Color(0.62, 0.10, 0.10));
  block(0.66, 0.93, Color(0.16, 0.10, 0.24));
  return c;
}

Color circles(double x, double y, double aspect) {
  Color c = mix(Color(0.93, 0.88, 0.76), Color(0.85, 0.80, 0.70),
                smoothStep(-0.3, 0.4, fractalNoise(x, y, 4, 3, 291)));
  Random random(293);
  const std::array<Color, 6> inks{Color(0.78, 0.16, 0.12), Color(0.10, 0.22, 0.48), Color(0.95, 0.72, 0.12),
                                  Color(0.08, 0.08, 0.09), Color(0.20, 0.48, 0.42), Color(0.62, 0.34, 0.56)};
  for (int k = 0; k < 16; ++k) {
    const double cx = random.uniform(0.08, 0.92), cy = random.uniform(0.1, 0.9),
                 r = random.uniform(0.03, 0.22) * (k < 3 ? 1.5 : 0.8);
    const Color ink = inks[static_cast<std::size_t>(k) % inks.size()];
    const double d = std::hypot((x - cx) * aspect, y - cy);
    if (k % 3 == 0) {
      if (d < r) c = mix(c, ink, 0.85);
    } else if (std::abs(d - r) < 0.012) {
      c = ink;
    } else if (d < 0.55 * r) {
      c = mix(c, inks[static_cast<std::size_t>(k + 2) % inks.size()], 0.8);
    }
  }
  for (int k = 0; k < 7; ++k) {
    const double angle = random.uniform(0.0, glm::pi<double>()), offset = random.uniform(-0.35, 0.35);
    const double d = (x - 0.5) * aspect * std::sin(angle) + (y - 0.5) * std::cos(angle) - offset;
    if (std::abs(d) < 0.006) c = Color(0.10, 0.09, 0.09);
  }
  return c;
}

Color grid(double x, double y) {
  const std::array<double, 4> columns{0.22, 0.62, 0.68, 0.90}, rows{0.16, 0.58, 0.82, 0.88};
  const auto cell = [](const std::array<double, 4>& cuts, double at) {
    return static_cast<int>(std::count_if(cuts.begin(), cuts.end(), [at](double cut) { return at > cut; }));
  };
  for (const double cut : columns) {
    if (std::abs(x - cut) < 0.011) return {0.07, 0.07, 0.08};
  }
  for (const double cut : rows) {
    if (std::abs(y - cut) < 0.011) return {0.07, 0.07, 0.08};
  }
  const int i = cell(columns, x), j = cell(rows, y);
  if (i == 1 && j == 1) return {0.80, 0.12, 0.09};
  if ((i == 0 && j == 2) || (i == 3 && j == 0)) return {0.10, 0.20, 0.50};
  if ((i == 4 && j == 3) || (i == 0 && j == 0) || (i == 2 && j == 4)) return {0.94, 0.78, 0.16};
  return {0.92, 0.90, 0.84};
}

Color stillLife(double x, double y, double aspect) {
  Color c = mix(Color(0.24, 0.17, 0.12), Color(0.42, 0.30, 0.18),
                smoothStep(0.9, 0.1, x) * (0.7 + 0.5 * fractalNoise(x, y, 4, 4, 301)));
  if (y > 0.68)
    c = mix(Color(0.46, 0.20, 0.12), Color(0.30, 0.12, 0.08),
            smoothStep(0.2, 0.9, x) + 0.2 * fractalNoise(x, y, 6, 3, 307));
  const auto ball = [&](double cx, double cy, double rx, double ry, const Color& color) {
    const double u = (x - cx) * aspect / rx, v = (y - cy) / ry, d = u * u + v * v;
    // Its shadow on the table, then the fruit lit from the upper left.
    const double su = (x - cx - 0.35 * rx) * aspect / (1.25 * rx), sv = (y - cy - 0.92 * ry) / (0.32 * ry);
    if (d > 1.0 && su * su + sv * sv < 1.0 && y > 0.68) c *= 0.55;
    if (d <= 1.0) {
      const double light = std::max(0.0, 0.75 * std::sqrt(1.0 - d) - 0.5 * u - 0.45 * v);
      c = color * (0.25 + 0.85 * light) + Color(0.7) * std::pow(light, 14.0) * 0.6;
    }
  };
  // A jug behind, fruit in front.
  const double jugRadius =
      0.13 * (0.55 + 0.45 * std::sin(glm::pi<double>() * std::clamp((y - 0.20) / 0.62, 0.0, 1.0)));
  if (y > 0.20 && y < 0.76) ball(0.34, y, jugRadius, 0.5, Color(0.30, 0.48, 0.60));
  ball(0.56, 0.72, 0.105, 0.100, Color(0.92, 0.50, 0.12));
  ball(0.72, 0.75, 0.095, 0.092, Color(0.80, 0.16, 0.10));
  ball(0.64, 0.80, 0.100, 0.096, Color(0.90, 0.76, 0.20));
  ball(0.46, 0.81, 0.080, 0.076, Color(0.42, 0.52, 0.14));
  return c;
}

struct Flower {
  double x, y, radius, tone;
};

/// From far to near, the far ones smaller.
std::vector<Flower> flowers() {
  Random random(331);
  std::vector<Flower> all;
  for (int k = 0; k < 240; ++k) {
    const double depth = std::pow(random.uniform(), 1.6), x = random.uniform();
    all.push_back({x, 0.40 + 0.6 * depth, 0.006 + 0.026 * depth, random.uniform(0.75, 1.05)});
  }
  std::sort(all.begin(), all.end(), [](const Flower& a, const Flower& b) { return a.y < b.y; });
  return all;
}

Color poppies(double x, double y, double aspect, const std::vector<Flower>& flowers) {
  Color c = y < 0.34 ? mix(Color(0.55, 0.70, 0.86), Color(0.90, 0.90, 0.84),
                           y / 0.34 + 0.3 * fractalNoise(x, y, 5, 4, 311))
                     : mix(Color(0.52, 0.56, 0.26), Color(0.26, 0.38, 0.14),
                           y + 0.5 * fractalNoise(x, y, 16, 3, 313));
  const double treeLine = 0.31 - 0.07 * fractalNoise(x, 0.5, 7, 4, 317);
  if (y > treeLine && y < 0.37) c = Color(0.20, 0.29, 0.21);
  for (const Flower& f : flowers) {
    const double dx = (x - f.x) * aspect, dy = (y - f.y) * 1.3;
    if (dx * dx + dy * dy < f.radius * f.radius) c = Color(0.88, 0.14, 0.08) * f.tone;
  }
  return c;
}

/// How a motif is painted: strokes follow the angle; a hard-edged one is put down flat.
struct Manner {
  double stroke;  ///< length of a coarse stroke, in picture heights
  double angle;   ///< radians, 0 along x
  double wander;  ///< radians the direction strays by
};

Manner mannerOf(Motif motif) {
  switch (motif) {
    case Motif::kMountains:
      return {0.07, 0.1, 0.6};
    case Motif::kSea:
      return {0.08, 0.0, 0.4};
    case Motif::kBirches:
      return {0.06, 1.4, 0.5};
    case Motif::kColorFields:
      return {0.10, 0.0, 1.2};
    case Motif::kCircles:
      return {0.02, 0.8, 0.8};
    case Motif::kGrid:
      return {0.02, 0.0, 0.2};
    case Motif::kStillLife:
      return {0.04, 0.9, 0.9};
    case Motif::kPoppies:
      return {0.035, 1.3, 0.7};
  }
  return {0.05, 0.0, 0.5};
}

Field fieldOf(Motif motif, double aspect) {
  switch (motif) {
    case Motif::kMountains:
      return mountains;
    case Motif::kSea:
      return sea;
    case Motif::kBirches:
      return birches;
    case Motif::kColorFields:
      return colorFields;
    case Motif::kCircles:
      return [aspect](double x, double y) { return circles(x, y, aspect); };
    case Motif::kGrid:
      return grid;
    case Motif::kStillLife:
      return [aspect](double x, double y) { return stillLife(x, y, aspect); };
    case Motif::kPoppies:
      return [aspect, all = flowers()](double x, double y) { return poppies(x, y, aspect, all); };
  }
  return grid;
}

}  // namespace

Picture painting(Motif motif, double aspect, int pixels) {
  const int width = aspect >= 1.0 ? pixels : static_cast<int>(pixels * aspect);
  const int height = aspect >= 1.0 ? static_cast<int>(pixels / aspect) : pixels;
  const Field field = fieldOf(motif, aspect);
  const Manner manner = mannerOf(motif);
  // The ground first, then strokes from long to short, each of the colour the field has at its middle.
  std::vector<Color> canvas;
  canvas.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) canvas.push_back(field((x + 0.5) / width, (y + 0.5) / height));
  }
  Random random(1000 + static_cast<std::uint64_t>(motif));
  for (const double fineness : {1.0, 0.6, 0.35}) {
    const double length = manner.stroke * height * fineness, breadth = std::max(1.2, 0.22 * length);
    const int count = static_cast<int>(1.6 * width * height / (length * breadth));
    for (int k = 0; k < count; ++k) {
      const double x = random.uniform(0.0, width), y = random.uniform(0.0, height);
      const double angle = manner.angle + manner.wander * fractalNoise(x / width, y / height, 4, 2, 401);
      const Color color = field(x / width, y / height) * random.uniform(0.92, 1.08);
      const double ax = std::cos(angle), ay = -std::sin(angle), reach = 0.5 * length + 1.0;
      for (int j = std::max(0, static_cast<int>(y - reach));
           j <= std::min(height - 1, static_cast<int>(y + reach)); ++j) {
        for (int i = std::max(0, static_cast<int>(x - reach));
             i <= std::min(width - 1, static_cast<int>(x + reach)); ++i) {
          const double dx = i + 0.5 - x, dy = j + 0.5 - y;
          const double along = (dx * ax + dy * ay) / (0.5 * length),
                       across = (dx * ay - dy * ax) / (0.5 * breadth);
          const double cover = smoothStep(1.0, 0.6, along * along + across * across);
          if (cover <= 0.0) continue;
          Color& under = canvas[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(i)];
          // The bristles leave the edges of a stroke a little darker.
          under = mix(under, color * (1.0 - 0.06 * std::abs(across)), 0.8 * cover);
        }
      }
    }
  }
  Picture picture{width, height, {}};
  picture.rgb.reserve(canvas.size() * 3);
  for (const Color& c : canvas) {
    for (int k = 0; k < 3; ++k) {
      picture.rgb.push_back(static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(c[k], 0.0, 1.0))));
    }
  }
  return picture;
}

}  // namespace promenade::hall
