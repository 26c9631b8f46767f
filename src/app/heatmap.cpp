#include "src/app/heatmap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <string_view>

namespace promenade::app {
namespace {

constexpr int kLegendRows = 24;
constexpr int kBarRows = 8;
constexpr int kGlyphScale = 2;

// Five rows of three bits each, the most significant bit of each on the left.
int glyph(char c) {
  switch (c) {
    case '0':
      return 0b111'101'101'101'111;
    case '1':
      return 0b010'110'010'010'111;
    case '2':
      return 0b111'001'111'100'111;
    case '5':
      return 0b111'100'111'001'111;
    case '7':
      return 0b111'001'010'010'010;
    case '.':
      return 0b000'000'000'000'010;
    case 'P':
      return 0b111'101'111'100'100;
    default:
      return 0;
  }
}

void draw(EncodedMap& image, int left, int top, std::string_view text) {
  for (const char c : text) {
    const int bits = glyph(c);
    for (int i = 0; i < 15; ++i) {
      if ((bits >> (14 - i) & 1) == 0) continue;
      for (int k = 0; k < kGlyphScale * kGlyphScale; ++k) {
        const int x = left + i % 3 * kGlyphScale + k % kGlyphScale;
        const int y = top + i / 3 * kGlyphScale + k / kGlyphScale;
        if (image.contains(x, y)) image(x, y) = Rgb(1.0f);
      }
    }
    left += 4 * kGlyphScale;
  }
}

}  // namespace

Rgb heatColour(float probability) {
  constexpr std::array<std::array<float, 3>, 5> kStops = {{{0.0f, 0.0f, 0.1f},
                                                           {0.34f, 0.06f, 0.43f},
                                                           {0.73f, 0.21f, 0.33f},
                                                           {0.98f, 0.55f, 0.04f},
                                                           {0.99f, 1.0f, 0.64f}}};
  const float t = std::clamp(probability, 0.0f, 1.0f) * 4.0f;
  const auto i = static_cast<std::size_t>(std::min(t, 3.0f));
  const auto colour = [&](std::size_t k) { return Rgb(kStops[k][0], kStops[k][1], kStops[k][2]); };
  return glm::mix(colour(i), colour(i + 1), t - static_cast<float>(i));
}

EncodedMap heatmap(const ProbabilityMap& probability, const LuminanceMap& background) {
  const int width = probability.width();
  const int height = probability.height();
  float brightest = 1e-6f;
  for (const float l : background.pixels()) brightest = std::max(brightest, l);
  EncodedMap image(width, height + kLegendRows, Rgb(0.0f));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float grey = 0.5f * std::pow(background(x, y) / brightest, 1.0f / 2.2f);
      const float p = probability(x, y);
      image(x, y) = glm::mix(Rgb(grey), heatColour(p), std::sqrt(std::clamp(p, 0.0f, 1.0f)));
    }
  }
  for (int x = 0; x < width; ++x) {
    const float p = width > 1 ? static_cast<float>(x) / static_cast<float>(width - 1) : 0.0f;
    for (int y = height + 2; y < height + 2 + kBarRows; ++y) image(x, y) = heatColour(p);
  }
  if (width < 240) return image;
  const int top = height + kBarRows + 4;
  constexpr std::array<std::string_view, 5> kLabels = {"P 0", "0.25", "0.5", "0.75", "1"};
  for (std::size_t k = 0; k < kLabels.size(); ++k) {
    const int textWidth = static_cast<int>(kLabels[k].size()) * 4 * kGlyphScale;
    const int centre = static_cast<int>(k) * (width - 1) / 4;
    draw(image, std::clamp(centre - textWidth / 2, 0, width - textWidth), top, kLabels[k]);
  }
  return image;
}

}  // namespace promenade::app
