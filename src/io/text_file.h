#pragma once
// Small text files, whole.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace promenade::io {

/// Nothing that a person or a program writes for us as text comes near this.
inline constexpr std::size_t kMaximumTextBytes = std::size_t{64} << 20;

/// Throws InputError if the file is missing, not a regular file, or larger than `maximumBytes`.
[[nodiscard]] std::string readTextFile(const std::filesystem::path& file,
                                       std::size_t maximumBytes = kMaximumTextBytes);

/// Whole or not at all (atomic_file.h).
void writeTextFile(const std::filesystem::path& file, std::string_view text);

}  // namespace promenade::io
