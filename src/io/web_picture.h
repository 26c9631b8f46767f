#pragma once
// Pictures inside a web page.

#include <string>

#include "src/core/image.h"

namespace promenade::io {

enum class PictureCoding {
  kPhoto,  ///< WebP, quality 80: small, not exact
  kFlat,   ///< WebP, lossless: for a few flat colours, which then stay those of a legend
};

/// "data:image/webp;base64,...", 8 bits a channel, tagged nothing (browsers take sRGB). The same image gives
/// the same text. Throws CannotContinue if WebP cannot be encoded. May be called from several threads at
/// once.
[[nodiscard]] std::string dataUri(const EncodedMap& image, PictureCoding coding);

/// Filtered to another size (OpenImageIO's box filter over the pixels that a new one covers). The size is
/// that of a smaller picture: sides in [1, those of `image`].
[[nodiscard]] EncodedMap reduced(const EncodedMap& image, Size size);

}  // namespace promenade::io
