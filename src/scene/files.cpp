#include "src/scene/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "src/core/errors.h"
#include "src/scene/text.h"

namespace promenade::scene {
namespace {

class FileDescriptor {
 public:
  explicit FileDescriptor(int fd) : fd_(fd) {}
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor() {
    if (fd_ >= 0) {
      ::close(fd_);
    }
  }
  [[nodiscard]] int get() const { return fd_; }

 private:
  int fd_;
};

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

int base64Digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;  // '-' and '_': base64url, which some exporters write
  if (c == '/' || c == '_') return 63;
  return -1;
}

Bytes decodeBase64(std::string_view text, const std::string& where) {
  while (!text.empty() && text.back() == '=') {
    text.remove_suffix(1);
  }
  Bytes bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : text) {
    const int digit = base64Digit(c);
    if (digit < 0) {
      throw InputError(where, "the data URI is not valid base64");
    }
    group = (group << 6) | static_cast<std::uint32_t>(digit);
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      bytes.push_back(static_cast<std::uint8_t>(group >> bits));
      group &= (1u << bits) - 1u;
    }
  }
  return bytes;
}

bool isInside(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const auto [folderEnd, ignored] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return folderEnd == folder.end();
}

/// A scheme as RFC 3986, 3.1 has it, at least two letters.
bool hasScheme(std::string_view uri) {
  const std::size_t colon = uri.find(':');
  if (colon == std::string_view::npos || colon < 2) {
    return false;
  }
  return std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '+' ||
           c == '-' || c == '.';
  });
}

}  // namespace

std::string decodePercent(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size() && hexDigit(text[i + 1]) >= 0 && hexDigit(text[i + 2]) >= 0) {
      result.push_back(static_cast<char>(hexDigit(text[i + 1]) * 16 + hexDigit(text[i + 2])));
      i += 2;
    } else {
      result.push_back(text[i]);
    }
  }
  return result;
}

bool isDataUri(std::string_view uri) {
  return uri.starts_with("data:");
}

Bytes decodeDataUri(std::string_view uri, const std::string& where) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) {
    throw InputError(where, "the data URI has no comma before its data");
  }
  const std::string_view header = uri.substr(0, comma);
  const std::string_view data = uri.substr(comma + 1);
  if (header.ends_with(";base64")) {
    return data.find('%') == std::string_view::npos ? decodeBase64(data, where)
                                                    : decodeBase64(decodePercent(data), where);
  }
  const std::string decoded = decodePercent(data);
  return Bytes(decoded.begin(), decoded.end());
}

Bytes readRegularFile(const std::filesystem::path& file, Budget& budget, std::uint64_t wanted) {
  const std::string where = printable(file.string());
  // The kind is looked at before the file is opened: opening a device can have effects, opening a pipe can
  // wait for ever.
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) {
    throw InputError(where, errno == ENOENT ? "no such file" : std::strerror(errno));
  }
  if (!S_ISREG(status.st_mode)) {
    throw InputError(where,
                     S_ISDIR(status.st_mode) ? "expected a file, found a folder" : "is not a regular file");
  }
  const FileDescriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (descriptor.get() < 0 || ::fstat(descriptor.get(), &status) != 0 || !S_ISREG(status.st_mode)) {
    throw InputError(where, std::string("cannot be read: ") + std::strerror(errno));
  }
  const std::uint64_t size = std::min(static_cast<std::uint64_t>(std::max<off_t>(status.st_size, 0)), wanted);
  budget.chargeFileBytes(size);
  Bytes bytes(size);
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::read(descriptor.get(), bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) {
      continue;
    }
    if (count < 0) {
      throw InputError(where, std::string("cannot be read: ") + std::strerror(errno));
    }
    if (count == 0) {
      bytes.resize(done);  // it was cut while we read it
      break;
    }
    done += static_cast<std::size_t>(count);
  }
  return bytes;
}

SceneFiles::SceneFiles(const std::filesystem::path& sceneFile, FileAccess access, Budget& budget)
    : access_(access), budget_(&budget) {
  std::error_code error;
  const std::filesystem::path parent = sceneFile.has_parent_path() ? sceneFile.parent_path() : ".";
  folder_ = std::filesystem::canonical(parent, error);
  if (error) {
    throw InputError(printable(sceneFile.string()), "no such file");
  }
}

std::filesystem::path SceneFiles::resolve(const std::string& uri, const std::string& where) const {
  if (hasScheme(uri)) {
    throw InputError(where, "only relative file names and data URIs are read, found " + inQuotes(uri));
  }
  const std::string name = decodePercent(uri);
  if (name.empty() || name.find('\0') != std::string::npos) {
    throw InputError(where, "expected a file name, found " + inQuotes(name));
  }
  std::error_code error;
  std::filesystem::path file = std::filesystem::weakly_canonical(folder_ / name, error);
  if (error) {
    throw InputError(where, "the file " + inQuotes(name) + " cannot be resolved: " + error.message());
  }
  if (access_ == FileAccess::kSceneFolder && !isInside(file, folder_)) {
    throw InputError(where, "the file " + inQuotes(name) +
                                " lies outside the scene's folder (allow it with --allow-outside-folder)");
  }
  return file;
}

std::shared_ptr<const Bytes> SceneFiles::read(const std::string& uri, const std::string& where) {
  if (isDataUri(uri)) {
    return std::make_shared<const Bytes>(decodeDataUri(uri, where));  // no larger than the JSON that holds it
  }
  const std::filesystem::path file = resolve(uri, where);
  const auto found = read_.find(file);
  if (found != read_.end()) {
    return found->second;
  }
  try {
    return read_.emplace(file, std::make_shared<const Bytes>(readRegularFile(file, *budget_))).first->second;
  } catch (const InputError& error) {
    throw InputError(where, error.what());
  }
}

}  // namespace promenade::scene
