#include "src/io/text_file.h"

#include <cerrno>
#include <fstream>

#include "src/core/errors.h"
#include "src/io/atomic_file.h"
#include "src/io/file_error.h"

namespace promenade::io {

std::string readTextFile(const std::filesystem::path& file, std::size_t maximumBytes) {
  requireRegularFile(file);
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) throwFileError(errno != 0 ? errno : EACCES, file, "open");
  std::string text;
  // Read rather than trust the size: the file may grow, and files of /proc have none.
  char chunk[65536];
  while (in.read(chunk, sizeof chunk) || in.gcount() > 0) {
    text.append(chunk, static_cast<std::size_t>(in.gcount()));
    if (text.size() > maximumBytes) {
      throw InputError(file.string(),
                       "expected at most " + std::to_string(maximumBytes) + " bytes, found more");
    }
  }
  if (in.bad()) throwFileError(EIO, file, "read");
  return text;
}

void writeTextFile(const std::filesystem::path& file, std::string_view text) {
  writeFileAtomically(file, std::as_bytes(std::span(text)));
}

}  // namespace promenade::io
