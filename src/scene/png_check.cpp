#include "src/scene/png_check.h"

#include <array>
#include <cstring>

namespace promenade::scene {
namespace {

constexpr std::size_t kSignature = 8;
// Length, type, checksum.
constexpr std::size_t kChunkOverhead = 12;

constexpr std::array<std::uint32_t, 256> makeTable() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t n = 0; n < 256; ++n) {
    std::uint32_t c = n;
    for (int k = 0; k < 8; ++k) {
      c = (c & 1u) != 0 ? 0xEDB88320u ^ (c >> 1) : c >> 1;
    }
    table[n] = c;
  }
  return table;
}

constexpr std::array<std::uint32_t, 256> kTable = makeTable();

/// CRC-32 of ISO 3309, as the PNG specification (annex D) has it.
std::uint32_t checksum(std::span<const std::uint8_t> bytes) {
  std::uint32_t c = 0xFFFFFFFFu;
  for (const std::uint8_t byte : bytes) {
    c = kTable[(c ^ byte) & 0xFFu] ^ (c >> 8);
  }
  return c ^ 0xFFFFFFFFu;
}

/// Big-endian.
std::uint32_t bigEndianWord(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint32_t>(bytes[at]) << 24 | static_cast<std::uint32_t>(bytes[at + 1]) << 16 |
         static_cast<std::uint32_t>(bytes[at + 2]) << 8 | static_cast<std::uint32_t>(bytes[at + 3]);
}

bool hasType(std::span<const std::uint8_t> chunk, const char* type) {
  return std::memcmp(chunk.data() + 4, type, 4) == 0;
}

}  // namespace

std::string pngDamage(std::span<const std::uint8_t> bytes) {
  std::size_t at = kSignature;
  while (bytes.size() >= at + kChunkOverhead) {
    const std::size_t length = bigEndianWord(bytes, at);
    if (length > bytes.size() - at - kChunkOverhead) {
      break;
    }
    const std::span<const std::uint8_t> chunk = bytes.subspan(at, length + kChunkOverhead);
    const std::string place = "the PNG is damaged: its chunk at byte " + std::to_string(at);
    if (bigEndianWord(chunk, length + 8) != checksum(chunk.subspan(4, length + 4))) {
      return place + " does not match its checksum";
    }
    if ((at == kSignature) != hasType(chunk, "IHDR") || (at == kSignature && length != 13)) {
      return place + " is not the header where it should be";
    }
    if (hasType(chunk, "IEND")) {
      return {};
    }
    at += chunk.size();
  }
  return "the PNG is cut off after " + std::to_string(bytes.size()) + " bytes";
}

}  // namespace promenade::scene
