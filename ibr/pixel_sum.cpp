#include "ibr/pixel_sum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace promenade::ibr {
namespace {

/// Of the variance of places in a pixel, 1/12 along each edge.
constexpr float kRidge = 0.01f;

/// Along one edge: the two cells whose middles are around a place, and how close each is.
struct Closeness {
  std::array<int, 2> cell;
  std::array<float, 2> share;
};

Closeness closeness(float place, int edge) {
  const float position = place * static_cast<float>(edge) - 0.5f;
  const float before = std::floor(position);
  const float fraction = position - before;
  const int first = static_cast<int>(before);
  // Beyond the outermost middles there is one cell only.
  return {{std::max(first, 0), std::min(first + 1, edge - 1)}, {1.0f - fraction, fraction}};
}

}  // namespace

PixelSum::PixelSum(int edge) : edge_(edge), cells_(static_cast<std::size_t>(edge * edge)) {}

void PixelSum::add(glm::vec2 place, const Rgb& radiance, float weight) {
  const Closeness across = closeness(place.x, edge_);
  const Closeness down = closeness(place.y, edge_);
  for (std::size_t k = 0; k < 4; ++k) {
    const float share = weight * across.share[k % 2] * down.share[k / 2];
    Cell& cell = cells_[static_cast<std::size_t>(down.cell[k / 2] * edge_ + across.cell[k % 2])];
    cell.radiance += share * radiance;
    cell.place += share * place;
    cell.weight += share;
  }
}

Rgb PixelSum::mean() const {
  // A cell counts in full from half of its due on: less says little of it.
  const float due = 0.5f * whole_ / static_cast<float>(cells_.size());
  const auto forEachCell = [&](const auto& work) {
    for (const Cell& cell : cells_) {
      if (!(cell.weight > 0.0f)) continue;
      work(std::min(1.0f, cell.weight / due), cell.radiance / cell.weight, cell.place / cell.weight);
    }
  };
  Rgb mean(0.0f);
  glm::vec2 middle(0.0f);
  float cells = 0.0f;
  forEachCell([&](float counts, const Rgb& value, glm::vec2 place) {
    mean += counts * value;
    middle += counts * place;
    cells += counts;
  });
  if (!(cells > 0.0f)) return Rgb(0.0f);
  mean /= cells;
  middle /= cells;

  // Least squares about the means: minimises sum (v - mean - g.(p - middle))^2 + ridge |g|^2 for the slope g;
  // the ridge makes it 0 where places do not differ.
  float xx = kRidge;
  float xy = 0.0f;
  float yy = kRidge;
  Rgb xv(0.0f);
  Rgb yv(0.0f);
  float vv = 0.0f;
  Rgb low = mean;
  Rgb high = mean;
  forEachCell([&](float counts, const Rgb& value, glm::vec2 place) {
    const float part = counts / cells;
    const glm::vec2 away = place - middle;
    xx += part * away.x * away.x;
    xy += part * away.x * away.y;
    yy += part * away.y * away.y;
    xv += (part * away.x) * (value - mean);
    yv += (part * away.y) * (value - mean);
    vv += part * glm::dot(value - mean, value - mean);
    low = glm::min(low, value);
    high = glm::max(high, value);
  });
  if (!(vv > 0.0f)) return mean;
  const float determinant = xx * yy - xy * xy;
  const Rgb alongX = (yy * xv - xy * yv) / determinant;
  const Rgb alongY = (xx * yv - xy * xv) / determinant;
  // The coefficient of determination: of an edge or a wire across the pixel a plane says little.
  const float explained = std::min((glm::dot(alongX, xv) + glm::dot(alongY, yv)) / vv, 1.0f);
  const glm::vec2 off = 0.5f - middle;
  return glm::clamp(mean + explained * (off.x * alongX + off.y * alongY), low, high);
}

}  // namespace promenade::ibr
