#pragma once
// Private to src/io: what a header may claim before anything is allocated for it.

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "src/core/errors.h"
#include "src/core/image.h"

namespace promenade::io {

inline constexpr std::size_t kMaximumPixels = std::size_t{1} << 27;  // 16384 x 8192
// No common format packs more pixels into a byte, constant images of the few that can aside; those are let
// through up to the second number.
inline constexpr std::size_t kMaximumPixelsPerByte = 10000;
inline constexpr std::size_t kAlwaysAllowedPixels = std::size_t{1} << 24;

inline void requireReasonableSize(const std::filesystem::path& file, Size size) {
  const std::string found = toString(size);
  if (size.width < 1 || size.height < 1) {
    throw InputError(file.string(), "expected an image of at least 1x1 pixels, found " + found);
  }
  if (size.area() > kMaximumPixels) {
    throw InputError(file.string(),
                     "expected at most " + std::to_string(kMaximumPixels) + " pixels, found " + found);
  }
  std::error_code error;
  const auto bytes = std::filesystem::file_size(file, error);
  if (!error && size.area() > kAlwaysAllowedPixels && size.area() / kMaximumPixelsPerByte > bytes) {
    throw InputError(file.string(), "claims " + found + " pixels in " + std::to_string(bytes) +
                                        " bytes: the file is damaged");
  }
}

/// Libraries explain themselves over several lines; a message of ours is one.
inline std::string firstLine(std::string_view text) {
  return std::string(text.substr(0, text.find('\n')));
}

}  // namespace promenade::io
