#pragma once
// Options from a file: TOML (the subset that options need) or JSON, told by the extension .json.
//
//     size = "640x360"        # strings, numbers, true, false
//     fps = 25
//     [render]                # what stands in a verb's own table is for that verb alone
//     overwrite = true

#include <string>
#include <vector>

namespace promenade::app {

struct ConfigEntry {
  std::string key;    ///< an option's name without the leading "--"
  std::string value;  ///< as it would be typed; "true" and "false" for flags
  std::string place;  ///< for messages: file and line or key
};

/// The entries that hold for `verb`: those outside of tables and those in the table of that name. Tables of
/// other verbs
/// (`verbs` lists all) are skipped. Throws InputError for text that cannot be read, tables that are no verb
/// (naming the nearest), repeated keys, values that are not a string, number or boolean.
[[nodiscard]] std::vector<ConfigEntry> parseConfig(const std::string& text, const std::string& fileName,
                                                   const std::string& verb,
                                                   const std::vector<std::string>& verbs);

}  // namespace promenade::app
