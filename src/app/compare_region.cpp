#include "src/app/compare_region.h"

#include <algorithm>
#include <variant>

#include "src/core/display.h"
#include "src/core/errors.h"

namespace promenade::app {

Mask excludedBy(const io::ImageFile& image) {
  Mask excluded(image.size(), 1);
  std::visit(
      [&](const auto& colour) {
        const auto pixels = colour.pixels();
        for (std::size_t i = 0; i < pixels.size(); ++i) {
          if (luminance(pixels[i]) > 0.5f) excluded.pixels()[i] = 0;
        }
      },
      image.colour);
  return excluded;
}

Region::Region(const std::string& argument, int frames) {
  if (argument.empty()) return;
  reader_.emplace(io::resolveSequence(argument));
  if (const int found = reader_->frameCount(); found != 1 && found != frames) {
    throw InputError("--mask", "expected one image or " + std::to_string(frames) +
                                   ", as there are frames, found " + std::to_string(found) + " in " +
                                   argument);
  }
}

const Mask& Region::next(Size size) {
  if (!reader_) return excluded_;
  const int file = frame_++;
  if (file > 0 && reader_->frameCount() == 1) return excluded_;
  const auto image = reader_->next();
  const std::string name = reader_->file(file).string();
  if (!image) throw InputError(name, "--mask: ends before its last frame");
  if (image->size() != size) {
    throw InputError(name, "--mask: expected the size of the frames, " + toString(size) + ", found " +
                               toString(image->size()));
  }
  excluded_ = excludedBy(*image);
  if (std::ranges::find(excluded_.pixels(), 0) == excluded_.pixels().end()) {
    throw InputError(name, "--mask: expected white where pixels count, found none");
  }
  return excluded_;
}

}  // namespace promenade::app
