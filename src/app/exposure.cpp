#include "src/app/exposure.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "src/core/adaptation.h"
#include "src/walkthrough/walkthrough.h"

namespace promenade::app {

double exposureFor(std::span<const io::Sequence> sequences) {
  constexpr std::size_t kFrames = 7;
  constexpr int kColumns = 8;  // of parts, as the renderer looks at its own frames
  std::vector<double> luminances;
  for (const io::Sequence& sequence : sequences) {
    const std::size_t images = sequence.images.size();
    for (std::size_t k = 0; k < std::min(kFrames, images); ++k) {
      const std::size_t index = images <= kFrames ? k : k * (images - 1) / (kFrames - 1);
      const io::ImageFile image = io::readImage(sequence.images[index], sequence.layer);
      if (const auto* radiance = std::get_if<RadianceMap>(&image.colour)) {
        const std::vector<double> parts = fovealLuminances(*radiance, kColumns);
        luminances.insert(luminances.end(), parts.begin(), parts.end());
      }
    }
  }
  return walkthrough::exposureOf(std::move(luminances));
}

}  // namespace promenade::app
