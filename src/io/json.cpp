#include "src/io/json.h"

#include <nlohmann/json.hpp>
#include <string>

#include "src/core/errors.h"

namespace promenade::io {
namespace {

constexpr int kMaximumDepth = 128;

template <class Json>
void write(const std::filesystem::path& file, const Json& value) {
  writeTextFile(file, value.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace

nlohmann::json readJson(const std::filesystem::path& file, std::size_t maximumBytes) {
  const std::string text = readTextFile(file, maximumBytes);
  const auto limitDepth = [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    if (depth > kMaximumDepth) {
      throw InputError(file.string(), "expected at most " + std::to_string(kMaximumDepth) + " nested levels");
    }
    return true;
  };
  try {
    return nlohmann::json::parse(text, limitDepth);
  } catch (const nlohmann::json::exception& error) {
    std::string what =
        error.what();  // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
    if (const auto bracket = what.find("] "); bracket != std::string::npos) what.erase(0, bracket + 2);
    throw InputError(file.string(), what);
  }
}

void writeJson(const std::filesystem::path& file, const nlohmann::json& value) {
  write(file, value);
}
void writeJson(const std::filesystem::path& file, const nlohmann::ordered_json& value) {
  write(file, value);
}

}  // namespace promenade::io
