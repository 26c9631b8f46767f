#pragma once
// 8-bit pictures for people: heat maps, contact sheets.

#include <filesystem>

#include "src/core/image.h"

namespace promenade::io {

/// An 8-bit RGB PNG tagged sRGB, values rounded to nearest (bytes.h); whole or not at all, the same image
/// gives the same bytes. Throws InputError or CannotContinue (file_error.h).
void write8bit(const std::filesystem::path& file, const EncodedMap& image);

/// Throws InputError for a PNG that ends before its IEND chunk; does nothing for files that are no PNG.
/// (libpng would tell on standard error, and leave its caller by longjmp.)
void requireWholePng(const std::filesystem::path& file);

}  // namespace promenade::io
