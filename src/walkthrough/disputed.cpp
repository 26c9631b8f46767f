#include "src/walkthrough/disputed.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "src/core/display.h"
#include "src/walkthrough/item_table.h"

namespace promenade::walkthrough {
namespace {

/// Of the larger luminance. (Compared with a fifth only.)
constexpr float kLargestDifference = 0.1f;
/// Of an item's samples that both keyframes fill.
constexpr double kLargestShare = 0.1;

}  // namespace

Mask disputedSamples(const WarpedPair& warped) {
  Mask disputed(warped.target.item.size());
  const auto items = warped.target.item.pixels();
  const auto luminanceOf = [](const ibr::Warped& source, std::size_t i) {
    return luminance(source.diffuse.pixels()[i] + source.viewDependent.pixels()[i]);
  };
  tbb::parallel_for(std::size_t{0}, items.size(), [&](std::size_t i) {
    if (items[i] == kNoItem || !warped.bothFill(i)) return;
    const float first = luminanceOf(warped.fromFirst, i);
    const float last = luminanceOf(warped.fromLast, i);
    if (std::abs(first - last) > kLargestDifference * std::max(first, last)) disputed.pixels()[i] = 1;
  });
  return disputed;
}

Mask disputedOf(const WarpedPair& warped, Disputes disputes, const Renderer& renderer) {
  Mask counting = warped.disputed.clone();
  ItemTable<bool> counts;
  const auto count = [&](ItemId item) { return countFor(disputes, renderer.traits(item)); };
  const auto items = warped.target.item.pixels();
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (counting.pixels()[i] != 0 && !counts.of(items[i], count)) counting.pixels()[i] = 0;
  }
  return counting;
}

ItemSet widelyDisputed(const Mask& disputed, const WarpedPair& warped) {
  struct Count {
    std::size_t filled = 0;
    std::size_t disputed = 0;
  };
  const auto items = warped.target.item.pixels();
  ItemTable<Count> counts;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!warped.bothFill(i)) continue;
    Count& count = counts.of(items[i], [](ItemId) { return Count(); });
    ++count.filled;
    if (disputed.pixels()[i] != 0) ++count.disputed;
  }
  std::vector<ItemId> widely;
  for (const auto& [item, count] : counts) {
    const double most = kLargestShare * static_cast<double>(count.filled);
    if (static_cast<double>(count.disputed) > most) widely.push_back(item);
  }
  return ItemSet(std::move(widely));
}

Mask disputedHereAndThere(const Mask& disputed, const ItemSet& widely, const WarpedPair& warped) {
  Mask few = disputed.clone();
  for (std::size_t i = 0; i < few.pixels().size(); ++i) {
    if (few.pixels()[i] != 0 && widely.contains(warped.target.item.pixels()[i])) few.pixels()[i] = 0;
  }
  return few;
}

}  // namespace promenade::walkthrough
