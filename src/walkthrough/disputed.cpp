#include "src/walkthrough/disputed.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <unordered_map>
#include <utility>
#include <vector>

#include "src/core/display.h"

namespace promenade::walkthrough {
namespace {

/// Of the larger luminance. (Compared with a fifth only.)
constexpr float kLargestDifference = 0.1f;
/// Of an item's samples that both keyframes fill.
constexpr double kLargestShare = 0.1;

}  // namespace

Mask disputedSamples(const WarpedPair& warped, Disputes disputes, const Renderer& renderer) {
  Mask disputed(warped.target.item.size());
  const auto luminanceOf = [](const ibr::Warped& source, std::size_t i) {
    return luminance(source.diffuse.pixels()[i] + source.viewDependent.pixels()[i]);
  };
  for (std::size_t i = 0; i < disputed.pixels().size(); ++i) {
    const ItemId item = warped.target.item.pixels()[i];
    if (item == kNoItem || !warped.bothFill(i)) continue;
    if (disputes != Disputes::kOfAllItems && !renderer.traits(item).viewDependent) continue;
    const float first = luminanceOf(warped.fromFirst, i);
    const float last = luminanceOf(warped.fromLast, i);
    if (std::abs(first - last) > kLargestDifference * std::max(first, last)) disputed.pixels()[i] = 1;
  }
  return disputed;
}

Mask disputedOf(const WarpedPair& warped, Disputes disputes, const Renderer& renderer) {
  return disputes == Disputes::kOfAllItems ? disputedSamples(warped, disputes, renderer)
                                           : warped.disputed.clone();
}

ItemSet widelyDisputed(const Mask& disputed, const WarpedPair& warped) {
  struct Count {
    std::size_t filled = 0;
    std::size_t disputed = 0;
  };
  const auto items = warped.target.item.pixels();
  std::unordered_map<ItemId, Count> counts;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!warped.bothFill(i)) continue;
    Count& count = counts[items[i]];
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

Mask disputedHereAndThere(const Mask& disputed, const WarpedPair& warped) {
  const ItemSet widely = widelyDisputed(disputed, warped);
  Mask few = disputed.clone();
  for (std::size_t i = 0; i < few.pixels().size(); ++i) {
    if (few.pixels()[i] != 0 && widely.contains(warped.target.item.pixels()[i])) few.pixels()[i] = 0;
  }
  return few;
}

}  // namespace promenade::walkthrough
