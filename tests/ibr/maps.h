#pragma once
// Making, comparing and counting maps.

#include <algorithm>
#include <cstring>
#include <limits>

#include "ibr/warp.h"

namespace promenade::ibr::tests {

/// Depth where there is no surface.
inline constexpr float kInfinitelyFar = std::numeric_limits<float>::infinity();
/// A footprint that nothing exceeds.
inline constexpr double kUnlimited = std::numeric_limits<double>::infinity();

template <class A, class B>
bool sameBits(const A& a, const B& b) {
  return a.size() == b.size() &&
         std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size_bytes()) == 0;
}

inline int count(const ValidityMap& map, Validity value) {
  return static_cast<int>(std::count(map.pixels().begin(), map.pixels().end(), value));
}

}  // namespace promenade::ibr::tests
