#include "src/io/video_pixels_internal.h"

#include <algorithm>
#include <cstring>

#include "src/io/bytes.h"
#include "src/io/palette.h"
#include "src/io/yuv420.h"

namespace promenade::io {
namespace {

void copyPlane(AVFrame& frame, int plane, const std::uint8_t* from, std::size_t rowBytes, int rows) {
  for (int y = 0; y < rows; ++y) {
    std::memcpy(frame.data[plane] + static_cast<std::ptrdiff_t>(y) * frame.linesize[plane],
                from + static_cast<std::size_t>(y) * rowBytes, rowBytes);
  }
}

}  // namespace

Size codedSize(VideoFormat format, Size size) {
  switch (format) {
    case VideoFormat::kH264:
    case VideoFormat::kVp9:
      return evenSize(size);
    case VideoFormat::kFfv1:  // FFmpeg 5.1 writes black for a side of one pixel
      return {std::max(size.width, 2), std::max(size.height, 2)};
    case VideoFormat::kGif:
      return size;
  }
  return size;
}

void fillFrame(AVFrame& target, const EncodedMap& image) {
  const auto width = static_cast<std::size_t>(target.width);
  switch (target.format) {
    case AV_PIX_FMT_YUV420P: {
      const Yuv420 yuv = toYuv420(image);
      copyPlane(target, 0, yuv.y.data(), width, target.height);
      copyPlane(target, 1, yuv.cb.data(), width / 2, target.height / 2);
      copyPlane(target, 2, yuv.cr.data(), width / 2, target.height / 2);
      break;
    }
    case AV_PIX_FMT_BGR0:
      for (int y = 0; y < target.height; ++y) {
        std::uint8_t* out = target.data[0] + static_cast<std::ptrdiff_t>(y) * target.linesize[0];
        for (int x = 0; x < target.width; ++x) {
          const Rgb& code = image(std::min(x, image.width() - 1), std::min(y, image.height() - 1));
          *out++ = toByte(code.b);
          *out++ = toByte(code.g);
          *out++ = toByte(code.r);
          *out++ = 0;
        }
      }
      break;
    default: {  // AV_PIX_FMT_PAL8
      copyPlane(target, 0, toPalette(image).data(), width, target.height);
      const auto palette = fixedPalette();
      std::memcpy(target.data[1], palette.data(), sizeof palette);
    }
  }
}

}  // namespace promenade::io
