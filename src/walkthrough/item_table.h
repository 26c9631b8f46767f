#pragma once
// Something known of each item, looked up sample by sample.

#include <unordered_map>

#include "src/core/image.h"

namespace promenade::walkthrough {

/// Neighbouring samples mostly show one item, so that to ask for the item that was asked for last takes a
/// comparison. Not for several threads at once.
template <class Value>
class ItemTable {
 public:
  ItemTable() = default;
  ItemTable(const ItemTable&) = delete;
  ItemTable& operator=(const ItemTable&) = delete;
  ~ItemTable() = default;

  /// The value of `item`: `make(item)` the first time.
  template <class Make>
  [[nodiscard]] Value& of(ItemId item, const Make& make) {
    if (last_ == nullptr || item != lastItem_) {
      const auto [entry, isNew] = values_.try_emplace(item);
      if (isNew) entry->second = make(item);
      lastItem_ = item;
      last_ = &entry->second;  // stays where it is when others come
    }
    return *last_;
  }
  /// Pairs of an item and its value, in no order.
  [[nodiscard]] auto begin() const { return values_.begin(); }
  [[nodiscard]] auto end() const { return values_.end(); }

 private:
  std::unordered_map<ItemId, Value> values_;
  ItemId lastItem_ = kNoItem;
  Value* last_ = nullptr;
};

}  // namespace promenade::walkthrough
