#pragma once
// JSON files.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "src/io/text_file.h"

namespace promenade::io {

/// Throws InputError with line and column if the file is not JSON, and if it nests deeper than 128.
[[nodiscard]] nlohmann::json readJson(const std::filesystem::path& file,
                                      std::size_t maximumBytes = kMaximumTextBytes);

/// Indented, keys in the order of the value's type, a newline at the end; whole or not at all. Text that is
/// not UTF-8 (a file name may be anything) is written with replacement characters.
void writeJson(const std::filesystem::path& file, const nlohmann::json& value);
void writeJson(const std::filesystem::path& file, const nlohmann::ordered_json& value);

}  // namespace promenade::io
