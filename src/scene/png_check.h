#pragma once
// Internal: whether a PNG is whole, before a decoder sees it. libpng reports damage on the standard error
// output, where only the application may write; and its header shows a picture's size before anything is
// allocated.

#include <cstdint>
#include <span>
#include <string>

namespace promenade::scene {

/// Empty if the signature, the lengths and the checksums of all chunks are good, up to the end chunk; else
/// what is wrong.
[[nodiscard]] std::string pngDamage(std::span<const std::uint8_t> bytes);

}  // namespace promenade::scene
