#pragma once
// What may follow an option: shown by --help and offered by shell completion.

#include <string>

namespace promenade::app {

/// Choices and placeholders separated by '|' ("ibr|full", "auto|EV"); FILE and DIR are completed as such.
/// Empty for a name that is not known here: then it is TEXT. `name` is an option ("--method") or an argument
/// ("scene").
[[nodiscard]] std::string valuesOf(const std::string& name);

}  // namespace promenade::app
