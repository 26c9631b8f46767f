#pragma once
// FNV-1a, 64 bits (Fowler, Noll, Vo): tells damaged bytes and other values from the same ones, not attackers.

#include <cstddef>
#include <cstdint>
#include <span>

namespace promenade {

[[nodiscard]] constexpr std::uint64_t fnv1a(std::span<const std::byte> bytes) {
  std::uint64_t state = 0xcbf29ce484222325u;
  for (const std::byte b : bytes) state = (state ^ static_cast<std::uint64_t>(b)) * 0x100000001b3u;
  return state;
}

}  // namespace promenade
