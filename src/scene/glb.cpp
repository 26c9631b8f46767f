#include "src/scene/glb.h"

#include "src/core/errors.h"

namespace promenade::scene {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67;      // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

/// Little-endian, as the container asks. Precondition: at + 4 <= bytes.size().
std::uint32_t littleEndianWord(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint32_t>(bytes[at]) | static_cast<std::uint32_t>(bytes[at + 1]) << 8 |
         static_cast<std::uint32_t>(bytes[at + 2]) << 16 | static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

}  // namespace

bool isGlb(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= 4 && littleEndianWord(bytes, 0) == kMagic;
}

GlbChunks splitGlb(std::span<const std::uint8_t> bytes, const std::string& source) {
  if (bytes.size() < 12) {
    throw InputError(source,
                     "the GLB header is cut off: expected 12 bytes, found " + std::to_string(bytes.size()));
  }
  if (littleEndianWord(bytes, 4) != 2) {
    throw InputError(source, "expected GLB version 2, found " + std::to_string(littleEndianWord(bytes, 4)));
  }
  const std::uint32_t length = littleEndianWord(bytes, 8);
  if (length > bytes.size()) {
    throw InputError(source, "the GLB header gives a length of " + std::to_string(length) +
                                 " bytes, the file has " + std::to_string(bytes.size()));
  }
  bytes = bytes.first(length);  // what follows the container is ignored
  GlbChunks chunks;
  std::size_t at = 12;
  for (std::size_t index = 0; at < bytes.size(); ++index) {
    const std::string where = "GLB chunk " + std::to_string(index);
    if (bytes.size() - at < 8) {
      throw InputError(source, where + ": its header is cut off");
    }
    const std::size_t size = littleEndianWord(bytes, at);
    const std::uint32_t type = littleEndianWord(bytes, at + 4);
    at += 8;
    if (size > bytes.size() - at) {
      throw InputError(source, where + ": needs " + std::to_string(size) + " bytes, the file has " +
                                   std::to_string(bytes.size() - at) + " left");
    }
    if (size % 4 != 0) {
      throw InputError(source, where + ": its length is not a multiple of 4");
    }
    const std::span<const std::uint8_t> content = bytes.subspan(at, size);
    if ((index == 0) != (type == kJsonChunk)) {
      throw InputError(source, where + (index == 0 ? ": expected JSON first" : ": a second JSON chunk"));
    }
    if (type == kJsonChunk) {
      chunks.json = std::string_view(reinterpret_cast<const char*>(content.data()), content.size());
    } else if (type == kBinaryChunk) {
      if (index != 1) {
        throw InputError(source, where + ": binary data belong into chunk 1, once");
      }
      chunks.binary = content;
    }
    at += size;
  }
  if (chunks.json.empty()) {
    throw InputError(source, "the GLB has no JSON");
  }
  return chunks;
}

}  // namespace promenade::scene
