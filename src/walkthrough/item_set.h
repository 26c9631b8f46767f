#pragma once
// A small sorted set of items.

#include <algorithm>
#include <vector>

#include "src/core/image.h"

namespace promenade::walkthrough {

class ItemSet {
 public:
  ItemSet() = default;
  explicit ItemSet(std::vector<ItemId> items) : items_(std::move(items)) {
    std::sort(items_.begin(), items_.end());
    items_.erase(std::unique(items_.begin(), items_.end()), items_.end());
  }
  [[nodiscard]] bool contains(ItemId item) const {
    return std::binary_search(items_.begin(), items_.end(), item);
  }
  /// What is in either.
  [[nodiscard]] ItemSet with(const ItemSet& more) const {
    std::vector<ItemId> both = items_;
    both.insert(both.end(), more.items_.begin(), more.items_.end());
    return ItemSet(std::move(both));
  }
  [[nodiscard]] bool empty() const { return items_.empty(); }
  [[nodiscard]] const std::vector<ItemId>& items() const { return items_; }

 private:
  std::vector<ItemId> items_;
};

}  // namespace promenade::walkthrough
