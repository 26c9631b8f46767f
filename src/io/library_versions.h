#pragma once

#include <string>
#include <utility>
#include <vector>

namespace promenade::io {

/// Names and versions of the libraries that read and write files, as they are loaded (OpenEXR: as built
/// with).
[[nodiscard]] std::vector<std::pair<std::string, std::string>> libraryVersions();

}  // namespace promenade::io
