#pragma once
// Files that are either whole or absent: written under a temporary name beside the final one, then renamed.

#include <cstddef>
#include <filesystem>
#include <span>

namespace promenade::io {

/// A file being written. Nothing appears under the final name before commit(); without commit() (an
/// exception) the destructor removes the temporary. A killed process leaves the temporary: its name is
/// recognisable (isTemporaryName) and removeLeftoverTemporaries() clears it away. A power failure
/// may lose the last files, but never leaves a half one.
class AtomicFile {
 public:
  /// Creates the temporary at once, so that a folder that cannot be written is known before any work is done.
  /// Throws InputError (folder missing or not writable, final name taken by something that is not a regular
  /// file) or CannotContinue (file_error.h).
  explicit AtomicFile(const std::filesystem::path& finalPath);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  [[nodiscard]] const std::filesystem::path& finalPath() const { return finalPath_; }
  /// For libraries that insist on opening the file themselves; it exists and is empty at first.
  [[nodiscard]] const std::filesystem::path& temporaryPath() const { return temporaryPath_; }

  /// Appends. Throws CannotContinue when the disk is full.
  void write(std::span<const std::byte> bytes);
  /// Gives the file its final name, replacing what was there. Call once, last.
  void commit();

 private:
  std::filesystem::path finalPath_;
  std::filesystem::path temporaryPath_;
  int descriptor_ = -1;
};

void writeFileAtomically(const std::filesystem::path& file, std::span<const std::byte> bytes);

/// True for the names that AtomicFile gives to temporaries: ".NAME.PID-N.promenade-tmp".
[[nodiscard]] bool isTemporaryName(const std::filesystem::path& file);

/// Removes the temporaries in `folder` (not below it) of processes that no longer run, and those that bear
/// this process's number (in containers numbers repeat): call it before this process writes there. Returns
/// how many.
int removeLeftoverTemporaries(const std::filesystem::path& folder);

}  // namespace promenade::io
