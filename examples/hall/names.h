#pragma once
// Names of nodes.

#include <string>
#include <string_view>

namespace promenade::hall {

namespace detail {
inline void append(std::string& name, std::string_view part) {
  name.append(part);
}
inline void append(std::string& name, std::size_t number) {
  name.append(std::to_string(number));
}
}  // namespace detail

/// The parts (texts and numbers) joined by hyphens: named("column", "left", 1U) is "column-left-1".
template <class First, class... Rest>
[[nodiscard]] std::string named(const First& first, const Rest&... rest) {
  std::string name;
  detail::append(name, first);
  ((name.push_back('-'), detail::append(name, rest)), ...);
  return name;
}

}  // namespace promenade::hall
