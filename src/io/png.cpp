#include "src/io/png.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

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
  OIIO::Filesystem::IOVecOutput memory;
  out->set_ioproxy(&memory);
  const std::vector<std::uint8_t> bytes = toRgbBytes(image);
  if (!out->open("memory.png", spec) || !out->write_image(OIIO::TypeDesc::UINT8, bytes.data()) ||
      !out->close()) {
    throw CannotContinue(file.string() + ": cannot encode PNG: " + firstLine(out->geterror()));
  }
  writeFileAtomically(file, std::as_bytes(std::span(memory.buffer())));
}

}  // namespace promenade::io
