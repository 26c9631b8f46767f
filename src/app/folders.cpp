#include "src/app/folders.h"

#include <system_error>

#include "src/core/errors.h"

namespace promenade::app {

void makeFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error == std::errc::no_space_on_device) {
    throw CannotContinue(folder.string() + ": cannot make the folder: " + error.message());
  }
  if (error) throw InputError(folder.string(), "cannot make the folder: " + error.message());
  if (!std::filesystem::is_directory(folder, error)) {
    throw InputError(folder.string(), "expected a folder, found a file of that name");
  }
}

}  // namespace promenade::app
