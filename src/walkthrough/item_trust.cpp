#include "src/walkthrough/item_trust.h"

#include <cstddef>
#include <utility>
#include <vector>

#include "src/walkthrough/item_table.h"

namespace promenade::walkthrough {

ItemTrust trustIn(const ItemBuffer& item, const ItemVerdict& verdict, const Renderer& renderer) {
  struct Known {
    bool looksTheSame = true;
    bool untrusted = false;
    bool disputesCount = false;
  };
  const auto know = [&](ItemId id) -> Known {
    if (id == kNoItem) return {};
    const ItemTraits traits = renderer.traits(id);
    const bool looksTheSame = verdict.looksTheSame(id, traits);
    return {looksTheSame, verdict.failing.contains(id) || (!looksTheSame && !verdict.proven.contains(id)),
            countFor(verdict.disputes, traits)};
  };
  ItemTable<Known> table;
  ItemTrust trust{Mask(item.size()), Mask(item.size()), Mask(item.size()), {}};
  for (std::size_t i = 0; i < item.pixels().size(); ++i) {
    const Known& known = table.of(item.pixels()[i], know);
    trust.looksTheSame.pixels()[i] = known.looksTheSame ? 1 : 0;
    trust.untrusted.pixels()[i] = known.untrusted ? 1 : 0;
    trust.disputesCount.pixels()[i] = known.disputesCount ? 1 : 0;
  }
  std::vector<ItemId> untrusted;
  for (const auto& [id, known] : table) {
    if (known.untrusted) untrusted.push_back(id);
  }
  trust.tracedWhole = ItemSet(std::move(untrusted));
  return trust;
}

}  // namespace promenade::walkthrough
