#pragma once
// Something that each part of the scene knows for each of the six axis directions that a surface in it may
// face, found when it is first asked for. It depends on nothing but its cell, so that images stay the same
// for any number of threads. Not part of the folder's public face.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "src/render/embree_scene.h"

namespace promenade::render {

/// PCG-XSH-RR of O'Neill (2014): only to jitter the rays that look around in a cell.
class Jitter {
 public:
  explicit Jitter(std::uint64_t seed) : state_(seed * 6364136223846793005ull + 1442695040888963407ull) {}
  float next() {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    const auto shifted = static_cast<std::uint32_t>(((state_ >> 18u) ^ state_) >> 27u);
    const auto turn = static_cast<std::uint32_t>(state_ >> 59u);
    const std::uint32_t bits = (shifted >> turn) | (shifted << ((32u - turn) & 31u));
    return static_cast<float>(bits >> 8) * 0x1p-24f;
  }

 private:
  std::uint64_t state_;
};

/// One side of one cell.
struct CellSide {
  static constexpr int kSides = 6;
  [[nodiscard]] static glm::vec3 axisOf(int side) {
    glm::vec3 axis(0.0f);
    axis[side / 2] = side % 2 == 0 ? 1.0f : -1.0f;
    return axis;
  }

  glm::vec3 corner{0.0f};  ///< of least coordinates
  float size = 1.0f;
  glm::vec3 axis{0.0f};  ///< which way the surfaces face, more or less: at most 55 degrees off
  int side = 0;          ///< the number of `axis`, below CellSide::kSides
  std::uint64_t number = 0;

  [[nodiscard]] glm::vec3 middle() const { return corner + 0.5f * size; }
  /// A point that such a surface may see. Points reach one cell further to the side that the surfaces face:
  /// most of their own cell may lie behind them.
  [[nodiscard]] glm::vec3 point(Jitter& jitter) const {
    const float x = jitter.next(), y = jitter.next(), z = jitter.next(), ahead = 1.25f * jitter.next();
    return corner + size * (glm::vec3(x, y, z) + ahead * axis);
  }
};

template <class View>
class CellViews {
 public:
  /// Cells are cubes, `alongLongestSide` of them along the longest side of `bounds`.
  CellViews(const EmbreeScene::Bounds& bounds, int alongLongestSide) : lower_(bounds.lower) {
    const glm::vec3 extent = bounds.upper - bounds.lower;
    const float longest = std::max(extent.x, std::max(extent.y, extent.z));
    size_ = longest > 0.0f && std::isfinite(longest) ? longest / static_cast<float>(alongLongestSide) : 1.0f;
    for (int i = 0; i < 3; ++i) {
      const float count = std::ceil(extent[i] / size_);
      cells_[i] = count >= 1.0f ? std::min(static_cast<int>(count), alongLongestSide + 1) : 1;
    }
    slotCount_ = static_cast<std::size_t>(cells_.x) * static_cast<std::size_t>(cells_.y) *
                 static_cast<std::size_t>(cells_.z) * CellSide::kSides;
    slots_ = std::make_unique<std::atomic<const View*>[]>(slotCount_);
  }
  ~CellViews() {
    for (std::size_t i = 0; i < slotCount_; ++i) delete slots_[i].load();
  }
  CellViews(const CellViews&) = delete;
  CellViews& operator=(const CellViews&) = delete;

  /// For a surface at `position` that faces `normal`; make(CellSide) gives a std::unique_ptr<View>. Any
  /// number of threads may ask.
  template <class Make>
  [[nodiscard]] const View& at(const glm::vec3& position, const glm::vec3& normal, const Make& make) const {
    glm::ivec3 cell;
    for (int i = 0; i < 3; ++i) {
      const float at = (position[i] - lower_[i]) / size_;
      cell[i] = at > 0.0f ? std::min(static_cast<int>(at), cells_[i] - 1) : 0;
    }
    const int side = sideOf(normal);
    const auto index = static_cast<std::size_t>((cell.z * cells_.y + cell.y) * cells_.x + cell.x);
    const std::size_t slot = index * CellSide::kSides + static_cast<std::size_t>(side);
    const View* view = slots_[slot].load(std::memory_order_acquire);
    if (view != nullptr) return *view;
    const CellSide place{lower_ + size_ * glm::vec3(cell), size_, CellSide::axisOf(side), side, slot};
    // Two threads may fill the same cell at once; both find the same, and one result is kept.
    std::unique_ptr<View> fresh = make(place);
    if (slots_[slot].compare_exchange_strong(view, fresh.get(), std::memory_order_acq_rel))
      return *fresh.release();
    return *view;
  }

 private:
  static int sideOf(const glm::vec3& normal) {
    const glm::vec3 a = glm::abs(normal);
    const int dimension = a.x >= a.y && a.x >= a.z ? 0 : (a.y >= a.z ? 1 : 2);
    return 2 * dimension + (normal[dimension] >= 0.0f ? 0 : 1);
  }

  glm::vec3 lower_{0.0f};
  float size_ = 1.0f;
  glm::ivec3 cells_{1};
  std::size_t slotCount_ = 0;
  std::unique_ptr<std::atomic<const View*>[]> slots_;
};

}  // namespace promenade::render
