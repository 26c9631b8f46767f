#pragma once
// Private to src/io: pictures in the pixel formats of the encoders.

#include "src/core/image.h"
#include "src/io/libav_internal.h"
#include "src/io/video.h"

namespace promenade::io {

/// The size that a format can hold pictures of `size` in; never smaller.
[[nodiscard]] Size codedSize(VideoFormat format, Size size);

/// Fills a frame of yuv420p, bgr0 or pal8 and codedSize(), repeating the last column and row where it is
/// larger than the image. The frame's buffers exist and are writable.
void fillFrame(AVFrame& target, const EncodedMap& image);

}  // namespace promenade::io
