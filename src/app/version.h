#pragma once

#include <string>

namespace promenade::app {

/// For `promenade --version`: "promenade VERSION", then how it was built, then a line a library with the
/// version that is loaded (header-only ones: that it was built with).
[[nodiscard]] std::string versionText();

}  // namespace promenade::app
