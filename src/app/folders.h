#pragma once

#include <filesystem>

namespace promenade::app {

/// Makes a folder with those above it, unless it is there. Throws InputError if that is not possible (a file
/// in its place, no permission), CannotContinue if the disk is full.
void makeFolder(const std::filesystem::path& folder);

}  // namespace promenade::app
