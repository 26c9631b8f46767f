#pragma once
// Published data, as comma-separated values with a head.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace promenade::validation {

using Row = std::map<std::string, std::string>;

/// Throws InputError if the file is missing.
[[nodiscard]] std::vector<Row> readTable(const std::filesystem::path& file);
/// Throws InputError if there is no such column, or no number in it.
[[nodiscard]] double numberIn(const Row& row, const std::string& column);

}  // namespace promenade::validation
