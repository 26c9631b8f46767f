#include "src/app/config_file.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "src/app/printable.h"
#include "src/core/errors.h"
#include "src/core/nearest_name.h"

namespace promenade::app {
namespace {

constexpr std::string_view kBlank = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

bool isVerb(const std::string& table, const std::vector<std::string>& verbs, const std::string& place) {
  if (std::find(verbs.begin(), verbs.end(), table) != verbs.end()) return true;
  const std::vector<std::string_view> names(verbs.begin(), verbs.end());
  throw InputError(
      place, "unknown table '" + printable(table) + "'; did you mean '" + nearestName(table, names) + "'?");
}

void add(std::vector<ConfigEntry>& entries, ConfigEntry entry) {
  const bool repeated =
      std::any_of(entries.begin(), entries.end(), [&](const ConfigEntry& e) { return e.key == entry.key; });
  if (repeated) throw InputError(entry.place, "the key '" + printable(entry.key) + "' is given twice");
  entries.push_back(std::move(entry));
}

// A TOML string (basic, without escapes other than \" and \\, or literal), number or boolean; a comment may
// follow.
std::string valueFrom(std::string_view text, const std::string& place) {
  const auto refuse = [&]() -> InputError {
    return InputError(place, "expected a string in quotes, a number, true or false, found '" +
                                 printable(text.substr(0, 60)) + "'");
  };
  std::string value;
  std::string_view rest;
  if (!text.empty() && (text.front() == '"' || text.front() == '\'')) {
    const char quote = text.front();
    std::size_t i = 1;
    for (; i < text.size() && text[i] != quote; ++i) {
      const bool escaped = quote == '"' && text[i] == '\\' && i + 1 < text.size();
      if (escaped && text[i + 1] != '"' && text[i + 1] != '\\') throw refuse();
      if (escaped) ++i;
      value += text[i];
    }
    if (i >= text.size()) throw refuse();
    rest = trimmed(text.substr(i + 1));
  } else {
    const std::size_t comment = std::min(text.find('#'), text.size());
    value = trimmed(text.substr(0, comment));
    rest = text.substr(comment);
    const bool number = !value.empty() && value.find_first_not_of("0123456789+-.eE") == std::string::npos;
    if (!number && value != "true" && value != "false") throw refuse();
  }
  if (!rest.empty() && rest.front() != '#') throw refuse();
  return value;
}

std::vector<ConfigEntry> fromToml(std::string_view text, const std::string& fileName, const std::string& verb,
                                  const std::vector<std::string>& verbs) {
  std::vector<ConfigEntry> entries;
  bool applies = true;
  int lineNumber = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::string place = fileName + ": line " + std::to_string(++lineNumber);
    if (line.empty() || line.front() == '#') continue;
    if (line.front() == '[') {
      const std::size_t close = line.find(']');
      if (close == std::string_view::npos) throw InputError(place, "expected ']' after the name of a table");
      const std::string table(trimmed(line.substr(1, close - 1)));
      applies = isVerb(table, verbs, place) && table == verb;
      continue;
    }
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) {
      throw InputError(place, "expected KEY = VALUE, found '" + printable(line.substr(0, 60)) + "'");
    }
    std::string_view key = trimmed(line.substr(0, equals));
    if (key.size() >= 2 && key.front() == '"' && key.back() == '"') key = key.substr(1, key.size() - 2);
    std::string value = valueFrom(trimmed(line.substr(equals + 1)), place);
    if (applies) add(entries, {std::string(key), std::move(value), place});
  }
  return entries;
}

using OrderedJson = nlohmann::ordered_json;

std::string textOf(const OrderedJson& value, const std::string& place) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  if (value.is_number()) return value.dump();
  throw InputError(place, "expected a string, a number, true or false");
}

std::vector<ConfigEntry> fromJson(const std::string& text, const std::string& fileName,
                                  const std::string& verb, const std::vector<std::string>& verbs) {
  const OrderedJson root = OrderedJson::parse(text, nullptr, false);
  if (!root.is_object()) throw InputError(fileName, "expected a JSON object of options");
  std::vector<ConfigEntry> entries;
  for (const auto& [key, value] : root.items()) {
    const std::string place = fileName + ": " + printable(key);
    if (!value.is_object()) {
      add(entries, {key, textOf(value, place), place});
      continue;
    }
    if (!isVerb(key, verbs, fileName) || key != verb) continue;
    for (const auto& [inner, innerValue] : value.items()) {
      const std::string innerPlace = place + "." + printable(inner);
      add(entries, {inner, textOf(innerValue, innerPlace), innerPlace});
    }
  }
  return entries;
}

}  // namespace

std::vector<ConfigEntry> parseConfig(const std::string& text, const std::string& fileName,
                                     const std::string& verb, const std::vector<std::string>& verbs) {
  return fileName.ends_with(".json") ? fromJson(text, fileName, verb, verbs)
                                     : fromToml(text, fileName, verb, verbs);
}

}  // namespace promenade::app
