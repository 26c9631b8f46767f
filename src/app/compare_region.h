#pragma once
// --mask: which pixels of a comparison count.

#include <optional>
#include <string>

#include "src/core/image.h"
#include "src/io/sequence.h"

namespace promenade::app {

/// Where the image's luminance is above one half (of white), a pixel counts.
[[nodiscard]] Mask excludedBy(const io::ImageFile& image);

/// The mask of each frame: of one image the same for all, of a sequence frame by frame.
class Region {
 public:
  /// `argument`: an image, a sequence of `frames` images or a video; empty: all pixels count. Throws
  /// InputError for another number of frames.
  Region(const std::string& argument, int frames);

  /// Nonzero where a pixel does not count; empty: all do. Called once a frame. Throws InputError that names
  /// the file if its size is not `size` or if no pixel counts.
  [[nodiscard]] const Mask& next(Size size);

 private:
  std::optional<io::SequenceReader> reader_;
  int frame_ = 0;
  Mask excluded_;
};

}  // namespace promenade::app
