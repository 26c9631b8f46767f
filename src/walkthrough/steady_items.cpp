#include "src/walkthrough/steady_items.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "src/core/display.h"
#include "src/walkthrough/item_table.h"

namespace promenade::walkthrough {
namespace {

/// Of all that a sample shows.
constexpr float kSteadyChange = 0.1f;
/// Of an item's samples that both keyframes fill: with textures finer than the samples some differ at any
/// distance. (In a kitchen an item with more of them than 6 per cent was seen to change where one keyframe
/// alone filled it.)
constexpr double kMostChanging = 0.05;
/// From fewer nothing can be told.
constexpr std::size_t kLeastCompared = 100;

}  // namespace

ItemSet steadyAmong(const ItemSet& proven, const WarpedPair& warped) {
  struct Count {
    bool isAsked = false;
    std::size_t compared = 0;
    std::size_t changing = 0;
  };
  ItemTable<Count> counts;
  const auto items = warped.target.item.pixels();
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!warped.bothFill(i)) continue;
    Count& count = counts.of(items[i], [&](ItemId item) { return Count{proven.contains(item)}; });
    if (!count.isAsked) continue;
    const float first = luminance(warped.fromFirst.viewDependent.pixels()[i]);
    const float last = luminance(warped.fromLast.viewDependent.pixels()[i]);
    const float whole = std::max(first + luminance(warped.fromFirst.diffuse.pixels()[i]),
                                 last + luminance(warped.fromLast.diffuse.pixels()[i]));
    ++count.compared;
    if (std::abs(first - last) > kSteadyChange * whole) ++count.changing;
  }
  std::vector<ItemId> steady;
  for (const auto& [item, count] : counts) {
    const double most = kMostChanging * static_cast<double>(count.compared);
    const bool isEnough = count.compared >= kLeastCompared;
    if (isEnough && static_cast<double>(count.changing) <= most) steady.push_back(item);
  }
  return ItemSet(std::move(steady));
}

}  // namespace promenade::walkthrough
