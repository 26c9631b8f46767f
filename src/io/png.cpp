#include "src/io/png.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <array>
#include <fstream>
#include <string_view>
#include <vector>

#include "src/core/errors.h"
#include "src/io/atomic_file.h"
#include "src/io/bytes.h"
#include "src/io/image_limits.h"

namespace promenade::io {

void write8bit(const std::filesystem::path& file, const EncodedMap& image) {
  const auto out = OIIO::ImageOutput::create("png");
  if (!out) throw CannotContinue(file.string() + ": cannot write PNG: " + firstLine(OIIO::geterror()));
  OIIO::ImageSpec spec(image.width(), image.height(), 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  // In memory first: AtomicFile then knows every way in which a disk can fail.
  out->threads(1);
  OIIO::Filesystem::IOVecOutput memory;
  out->set_ioproxy(&memory);
  const std::vector<std::uint8_t> bytes = toRgbBytes(image);
  if (!out->open("memory.png", spec) || !out->write_image(OIIO::TypeDesc::UINT8, bytes.data()) ||
      !out->close()) {
    throw CannotContinue(file.string() + ": cannot encode PNG: " + firstLine(out->geterror()));
  }
  writeFileAtomically(file, std::as_bytes(std::span(memory.buffer())));
}

void requireWholePng(const std::filesystem::path& file) {
  constexpr std::string_view kSignature{"\x89PNG\r\n\x1a\n", 8};
  std::ifstream in(file, std::ios::binary);
  std::array<char, 8> head{};
  in.read(head.data(), head.size());
  if (!in || std::string_view(head.data(), head.size()) != kSignature) return;
  // Chunks: length (big-endian), type, data, checksum.
  const auto end = static_cast<std::streamoff>(std::filesystem::file_size(file));
  std::streamoff next = 8;
  for (std::string_view type; type != "IEND"; type = std::string_view(head.data() + 4, 4)) {
    in.seekg(next);
    in.read(head.data(), head.size());
    std::uint32_t length = 0;
    for (int i = 0; i < 4; ++i)
      length = length << 8 | static_cast<unsigned char>(head[static_cast<std::size_t>(i)]);
    next += 12 + static_cast<std::streamoff>(length);
    if (!in || next > end) throw InputError(file.string(), "the PNG is cut short");
  }
}

}  // namespace promenade::io
