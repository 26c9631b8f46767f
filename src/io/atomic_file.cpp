#include "src/io/atomic_file.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "src/core/errors.h"
#include "src/io/file_error.h"

namespace promenade::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSuffix = ".promenade-tmp";

// The process number in ".NAME.PID-N.promenade-tmp".
std::optional<pid_t> ownerOf(const fs::path& file) {
  const std::string name = file.filename().string();
  std::string_view rest = name;
  if (!rest.starts_with('.') || !rest.ends_with(kSuffix)) return std::nullopt;
  rest.remove_suffix(kSuffix.size());
  const auto dash = rest.rfind('-');
  if (dash == std::string_view::npos) return std::nullopt;
  const auto dot = rest.rfind('.', dash);
  if (dot == std::string_view::npos || dot == 0) return std::nullopt;
  const std::string_view digits = rest.substr(dot + 1, dash - dot - 1);
  pid_t owner = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), owner);
  if (error != std::errc{} || end != digits.data() + digits.size() || owner <= 0) return std::nullopt;
  return owner;
}

bool runs(pid_t process) {
  return ::kill(process, 0) == 0 || errno != ESRCH;
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& finalPath) : finalPath_(finalPath) {
  std::error_code ignored;
  // Writing through a link replaces what it points to, not the link.
  if (fs::is_symlink(finalPath_, ignored)) finalPath_ = fs::weakly_canonical(finalPath_, ignored);
  if (finalPath_.filename().empty()) throw InputError(finalPath.string(), "expected the name of a file");
  const fs::file_type type = fs::status(finalPath_, ignored).type();
  if (type == fs::file_type::directory) {
    throw InputError(finalPath.string(), "expected the name of a file, found a folder");
  }
  if (type != fs::file_type::regular && type != fs::file_type::not_found && type != fs::file_type::none) {
    throw InputError(finalPath.string(),
                     "exists and is not a regular file");  // renaming would destroy a device
  }
  std::string stem = ".";
  stem.append(finalPath_.filename().string()).append(".").append(std::to_string(::getpid())).append("-");
  for (int attempt = 0; descriptor_ < 0; ++attempt) {
    temporaryPath_ = finalPath_;
    temporaryPath_.replace_filename(stem + std::to_string(attempt).append(kSuffix));
    descriptor_ = ::open(temporaryPath_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST) throwFileError(errno, finalPath_, "create the file");
  }
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporaryPath_.empty()) ::unlink(temporaryPath_.c_str());
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      throwFileError(errno, finalPath_, "write");
    }
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void AtomicFile::commit() {
  const int descriptor = descriptor_;
  descriptor_ = -1;
  // Before the name appears, the bytes are where a power failure cannot take them. (EINVAL: a file system
  // without such a place.)
  if (::fsync(descriptor) != 0 && errno != EINVAL) {
    const int error = errno;
    ::close(descriptor);
    throwFileError(error, finalPath_, "write");
  }
  // Network file systems report a full disk only here.
  if (::close(descriptor) != 0 && errno != EINTR) throwFileError(errno, finalPath_, "write");
  if (::rename(temporaryPath_.c_str(), finalPath_.c_str()) != 0) throwFileError(errno, finalPath_, "write");
  temporaryPath_.clear();
}

void writeFileAtomically(const fs::path& file, std::span<const std::byte> bytes) {
  AtomicFile out(file);
  out.write(bytes);
  out.commit();
}

bool isTemporaryName(const fs::path& file) {
  return ownerOf(file).has_value();
}

int removeLeftoverTemporaries(const fs::path& folder) {
  std::vector<fs::path> leftovers;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const auto owner = ownerOf(entry->path());
    if (owner && (*owner == ::getpid() || !runs(*owner))) leftovers.push_back(entry->path());
  }
  if (error && error.value() != ENOENT) throwFileError(error.value(), folder, "list the folder");
  int removed = 0;
  for (const fs::path& file : leftovers) {
    if (fs::remove(file, error)) ++removed;
    if (error) throwFileError(error.value(), file, "remove the file");
  }
  return removed;
}

}  // namespace promenade::io
