#include "src/walkthrough/moved_gloss.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "ibr/angle.h"
#include "ibr/source_surface.h"
#include "src/core/display.h"
#include "src/walkthrough/item_table.h"
#include "src/walkthrough/slant.h"

namespace promenade::walkthrough {
namespace {

/// Of what a sample shows, by what its gloss is expected to have changed. Measured (docs/method.md), it has
/// changed by about as much, in broad patches, of which the metric finds 2 or 3 per cent visible.
constexpr double kLargestContrast = 0.03;
/// Samples along the edge of a tile. What is known around a sample is what its tile and the eight around it
/// show: the change is looked at as coarsely as the eye would find it, and aliasing averages out.
constexpr int kTile = 16;
/// Samples. From fewer nothing can be told.
constexpr double kLeastComparedAround = 32.0;

/// What the keyframes show of an item in some tiles, samples that both fill: sums.
struct GlossBetween {
  double samples = 0.0;
  double change = 0.0;  ///< of the luminance of the gloss, from the first keyframe to the last
  double turn = 0.0;    ///< radians between the lines of sight from the two

  GlossBetween& operator+=(const GlossBetween& more) {
    samples += more.samples;
    change += more.change;
    turn += more.turn;
    return *this;
  }
  /// Of the luminance of the gloss, where the line of sight turns by `radians`: in proportion, but never by
  /// more than between the keyframes.
  [[nodiscard]] double changeBy(double radians) const {
    if (samples < kLeastComparedAround || !(turn > 0.0)) return 0.0;
    return std::abs(change) / samples * std::min(1.0, radians * samples / turn);
  }
};

class GlossTiles {
 public:
  GlossTiles(const ibr::Blended& blended, const WarpedPair& keyframes, const Mask& looksTheSame)
      : blended_(blended),
        keyframes_(keyframes),
        looksTheSame_(looksTheSame),
        across_((looksTheSame.width() + kTile - 1) / kTile),
        down_((looksTheSame.height() + kTile - 1) / kTile),
        tiles_(static_cast<std::size_t>(across_) * static_cast<std::size_t>(down_)) {
    tbb::parallel_for(0, down_, [&](int row) {
      for (int column = 0; column < across_; ++column) at(column, row) = between(column, row);
    });
  }

  void select(Mask& selected) const {
    tbb::parallel_for(0, down_, [&](int row) {
      for (int column = 0; column < across_; ++column) select(column, row, selected);
    });
  }

 private:
  struct OfItem {
    ItemId item = kNoItem;
    GlossBetween gloss;
  };
  using Tile = std::vector<OfItem>;  ///< of a few items

  [[nodiscard]] Tile& at(int column, int row) {
    return tiles_[static_cast<std::size_t>(row) * static_cast<std::size_t>(across_) +
                  static_cast<std::size_t>(column)];
  }
  [[nodiscard]] const Tile& at(int column, int row) const {
    return tiles_[static_cast<std::size_t>(row) * static_cast<std::size_t>(across_) +
                  static_cast<std::size_t>(column)];
  }

  template <class Visit>
  void forEachSample(int column, int row, const Visit& visit) const {
    const int endY = std::min((row + 1) * kTile, looksTheSame_.height());
    const int endX = std::min((column + 1) * kTile, looksTheSame_.width());
    for (int y = row * kTile; y < endY; ++y) {
      for (int x = column * kTile; x < endX; ++x) {
        if (looksTheSame_(x, y) != 0 && blended_.frame.visibility.item(x, y) != kNoItem) visit(x, y);
      }
    }
  }

  [[nodiscard]] Tile between(int column, int row) const {
    const Visibility& target = blended_.frame.visibility;
    const ibr::RayBasis rays(target.camera);
    const glm::dvec3 eye = target.camera.pose().eye;
    const ibr::Warped& first = keyframes_.fromFirst;
    const ibr::Warped& last = keyframes_.fromLast;
    ItemTable<GlossBetween> items;
    forEachSample(column, row, [&](int x, int y) {
      if (first.validity(x, y) != ibr::Validity::kValid || last.validity(x, y) != ibr::Validity::kValid)
        return;
      const glm::vec3 point = target.depth(x, y) * rays.through(x, y);
      const float turn =
          ibr::angleBetween(point + glm::vec3(eye - first.eye), point + glm::vec3(eye - last.eye));
      const float change = luminance(last.viewDependent(x, y)) - luminance(first.viewDependent(x, y));
      items.of(target.item(x, y), [](ItemId) { return GlossBetween(); }) +=
          {1.0, static_cast<double>(change), static_cast<double>(turn)};
    });
    Tile tile;
    for (const auto& [item, gloss] : items) tile.push_back({item, gloss});
    return tile;
  }

  /// Tiles are added in a fixed order, so that sums are the same whenever they are made.
  [[nodiscard]] GlossBetween around(int column, int row, ItemId item) const {
    GlossBetween sum;
    for (int j = std::max(row - 1, 0); j <= std::min(row + 1, down_ - 1); ++j) {
      for (int i = std::max(column - 1, 0); i <= std::min(column + 1, across_ - 1); ++i) {
        for (const OfItem& known : at(i, j)) {
          if (known.item == item) sum += known.gloss;
        }
      }
    }
    return sum;
  }

  void select(int column, int row, Mask& selected) const {
    const Frame& frame = blended_.frame;
    ItemTable<GlossBetween> items;
    forEachSample(column, row, [&](int x, int y) {
      const float turn = blended_.turn(x, y);
      if (!(turn > 0.0f) || selected(x, y) != 0) return;
      const GlossBetween& gloss =
          items.of(frame.visibility.item(x, y), [&](ItemId item) { return around(column, row, item); });
      const double shown = luminance(frame.diffuse(x, y)) + luminance(frame.viewDependent(x, y));
      if (gloss.changeBy(static_cast<double>(turn)) > kLargestContrast * shown) selected(x, y) = 1;
    });
  }

  const ibr::Blended& blended_;
  const WarpedPair& keyframes_;
  const Mask& looksTheSame_;
  int across_;
  int down_;
  std::vector<Tile> tiles_;
};

}  // namespace

Mask holesAndChangedGloss(const ibr::Blended& blended, const WarpedPair& keyframes,
                          const Mask& looksTheSame) {
  Mask selected = holesAndSlantedGloss(blended, looksTheSame);
  GlossTiles(blended, keyframes, looksTheSame).select(selected);
  return selected;
}

}  // namespace promenade::walkthrough
