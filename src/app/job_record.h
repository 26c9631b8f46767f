#pragma once
// What is kept of a job in its folder, to be read again by later runs of the same program.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "src/io/json.h"

namespace promenade::app {

/// What `read` makes of a record of this job; nothing if the file is missing, of another job (its key `job`
/// is not `jobHash`), or not of this program (`read` throws nlohmann::json::exception). Throws InputError for
/// a file that cannot be read.
template <class Read>
auto fromRecord(const std::filesystem::path& file, const std::string& jobHash, const Read& read)
    -> std::optional<decltype(read(nlohmann::json()))> {
  if (!std::filesystem::is_regular_file(file)) return std::nullopt;
  try {
    const nlohmann::json root = nlohmann::json::parse(io::readTextFile(file));
    if (root.at("job") != jobHash) return std::nullopt;
    return read(root);
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

}  // namespace promenade::app
