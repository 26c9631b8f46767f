#include "src/io/bytes.h"

namespace promenade::io {

std::vector<std::uint8_t> toRgbBytes(const EncodedMap& image) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * image.size().area());
  for (const Rgb& code : image.pixels()) {
    bytes.push_back(toByte(code.r));
    bytes.push_back(toByte(code.g));
    bytes.push_back(toByte(code.b));
  }
  return bytes;
}

}  // namespace promenade::io
