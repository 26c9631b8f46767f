#pragma once

#include <string>
#include <vector>

namespace promenade::app {

/// The words as a POSIX shell reads them back: quoted where they hold anything but letters, digits and
/// -_./,:=+@%
[[nodiscard]] std::string shellWords(const std::vector<std::string>& words);

}  // namespace promenade::app
