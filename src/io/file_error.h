#pragma once
// Which of the project's errors a failed system call is.

#include <filesystem>
#include <string_view>

namespace promenade::io {

/// Throws CannotContinue for a machine that cannot take more (disk full, quota, file size limit, I/O error,
/// no memory, no descriptors) and InputError for a path that cannot be used (missing, not permitted, not a
/// folder, read-only). The message is "FILE: cannot ACTION: reason".
[[noreturn]] void throwFileError(int errnoValue, const std::filesystem::path& file, std::string_view action);

/// Throws InputError unless `file` exists and is a regular file: opening a pipe or a device may block for
/// ever.
void requireRegularFile(const std::filesystem::path& file);

}  // namespace promenade::io
