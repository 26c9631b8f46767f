#pragma once
// Private to src/io: what every reader of OpenEXR files does around its reading.

#include <OpenEXR/Iex.h>

#include <filesystem>

#include "src/core/errors.h"
#include "src/io/file_error.h"
#include "src/io/image_limits.h"

namespace promenade::io {

/// read(), where `file` is a regular file. OpenEXR's exceptions become InputError: whatever is wrong with the
/// file is wrong with the input.
template <class Read>
auto readingExr(const std::filesystem::path& file, const Read& read) {
  requireRegularFile(file);
  try {
    return read();
  } catch (const Iex::BaseExc& error) {
    throw InputError(file.string(), "cannot read as OpenEXR: " + firstLine(error.what()));
  }
}

}  // namespace promenade::io
