#include "src/io/file_error.h"

#include <cerrno>
#include <string>
#include <system_error>

#include "src/core/errors.h"

namespace promenade::io {

void throwFileError(int errnoValue, const std::filesystem::path& file, std::string_view action) {
  const std::string message =
      file.string() + ": cannot " + std::string(action) + ": " + std::system_category().message(errnoValue);
  switch (errnoValue) {
    case ENOENT:
    case ENOTDIR:
    case EISDIR:
    case EACCES:
    case EPERM:
    case EROFS:
    case ELOOP:
    case ENAMETOOLONG:
    case EINVAL:
      throw InputError(message);
    default:
      throw CannotContinue(message);
  }
}

void requireRegularFile(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found) throw InputError(file.string(), "no such file");
  if (status.type() == std::filesystem::file_type::none) throwFileError(error.value(), file, "open");
  if (status.type() == std::filesystem::file_type::directory) {
    throw InputError(file.string(), "expected a file, found a folder");
  }
  if (status.type() != std::filesystem::file_type::regular) {
    throw InputError(file.string(), "expected a regular file, found a pipe, socket or device");
  }
}

}  // namespace promenade::io
