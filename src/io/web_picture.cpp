#include "src/io/web_picture.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include <cassert>

#include "src/core/errors.h"
#include "src/io/bytes.h"
#include "src/io/image_limits.h"

namespace promenade::io {

std::string dataUri(const EncodedMap& image, PictureCoding coding) {
  const auto out = OIIO::ImageOutput::create("webp");
  if (!out) throw CannotContinue("WebP: cannot encode: " + firstLine(OIIO::geterror()));
  OIIO::ImageSpec spec(image.width(), image.height(), 3, OIIO::TypeDesc::UINT8);
  spec.attribute("compression", coding == PictureCoding::kFlat ? "lossless:100" : "webp:80");
  out->threads(1);
  OIIO::Filesystem::IOVecOutput memory;
  out->set_ioproxy(&memory);
  const std::vector<std::uint8_t> bytes = toRgbBytes(image);
  if (!out->open("memory.webp", spec) || !out->write_image(OIIO::TypeDesc::UINT8, bytes.data()) ||
      !out->close()) {
    throw CannotContinue("WebP: cannot encode: " + firstLine(out->geterror()));
  }
  const auto& coded = memory.buffer();
  return "data:image/webp;base64," +
         OIIO::Strutil::base64_encode({reinterpret_cast<const char*>(coded.data()), coded.size()});
}

EncodedMap reduced(const EncodedMap& image, Size size) {
  assert(size.width >= 1 && size.height >= 1 && size.width <= image.width() && size.height <= image.height());
  if (size == image.size()) return image.clone();
  OIIO::ImageSpec from(image.width(), image.height(), 3, OIIO::TypeDesc::FLOAT);
  // OpenImageIO only reads from it.
  const OIIO::ImageBuf source(from, const_cast<Rgb*>(image.pixels().data()));
  const OIIO::ROI roi(0, size.width, 0, size.height, 0, 1, 0, 3);
  const OIIO::ImageBuf made = OIIO::ImageBufAlgo::resize(source, "box", 0.0f, roi, 1);
  EncodedMap result(size);
  made.get_pixels(roi, OIIO::TypeDesc::FLOAT, result.pixels().data());
  return result;
}

}  // namespace promenade::io
