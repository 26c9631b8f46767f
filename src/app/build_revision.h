#pragma once
// Defined by a file that every build makes again (cmake/Revision.cmake).

#include <string>

namespace promenade::app {

/// The commit that was built, with "-dirty" where files differed from it; "unknown" outside of a repository.
[[nodiscard]] std::string buildRevision();

}  // namespace promenade::app
