#pragma once
// Strings from files made fit for messages, and the list of warnings.

#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace promenade::scene {

/// Control characters replaced and long text cut: what a file says never breaks a line or a terminal.
[[nodiscard]] std::string printable(std::string_view text);
/// printable() in double quotes.
[[nodiscard]] std::string inQuotes(std::string_view text);

/// Warnings, each said once.
class Warnings {
 public:
  void add(std::string line);
  [[nodiscard]] std::vector<std::string> take();

 private:
  std::vector<std::string> lines_;
  std::unordered_set<std::string> seen_;
  std::size_t unsaid_ = 0;
};

}  // namespace promenade::scene
