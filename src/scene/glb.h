#pragma once
// The GLB container (glTF 2.0, 4.4).

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace promenade::scene {

struct GlbChunks {
  std::string_view json;
  std::optional<std::span<const std::uint8_t>> binary;
};

[[nodiscard]] bool isGlb(std::span<const std::uint8_t> bytes);

/// Splits a GLB into its chunks (views into `bytes`). Throws InputError: wrong version, lengths that do not
/// fit, a first chunk that is not JSON, more than one JSON or BIN chunk, an unfinished chunk. Unknown chunks
/// are skipped.
[[nodiscard]] GlbChunks splitGlb(std::span<const std::uint8_t> bytes, const std::string& source);

}  // namespace promenade::scene
