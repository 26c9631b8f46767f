#include "ibr/pixel_sum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace promenade::ibr {
namespace {

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

void PixelSum::add(glm::vec2 place, const Rgb& radiance, float weight, Seen seen) {
  const bool isCertain = seen == Seen::kClearly;
  (isCertain ? certain_ : possible_) += weight;
  const Closeness across = closeness(place.x, edge_);
  const Closeness down = closeness(place.y, edge_);
  for (std::size_t k = 0; k < 4; ++k) {
    const float share = weight * across.share[k % 2] * down.share[k / 2];
    Cell& cell = cells_[static_cast<std::size_t>(down.cell[k / 2] * edge_ + across.cell[k % 2])];
    Sum& sum = isCertain ? cell.certain : cell.possible;
    sum.radiance += share * radiance;
    sum.weight += share;
  }
}

Rgb PixelSum::mean() const {
  const float left = std::clamp(whole_ - certain_, 0.0f, possible_);
  const float possible = possible_ > 0.0f ? left / possible_ : 0.0f;
  // A cell counts in full from half of its due on: less says little of it.
  const float due = 0.5f * whole_ / static_cast<float>(cells_.size());
  Rgb sum(0.0f);
  float cells = 0.0f;
  for (const Cell& cell : cells_) {
    const float weight = cell.certain.weight + possible * cell.possible.weight;
    if (!(weight > 0.0f)) continue;
    const float counts = std::min(1.0f, weight / due);
    sum += (cell.certain.radiance + possible * cell.possible.radiance) * (counts / weight);
    cells += counts;
  }
  return cells > 0.0f ? sum / cells : Rgb(0.0f);
}

}  // namespace promenade::ibr
