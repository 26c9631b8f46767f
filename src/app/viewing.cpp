#include "src/app/viewing.h"

#include <cmath>
#include <string>
#include <utility>
#include <variant>

#include "ibr/flow.h"
#include "src/app/motion.h"
#include "src/core/errors.h"

namespace promenade::app {

Shown shownBoth(const io::ImageFile& a, const io::ImageFile& b, const Viewing& viewing, int index) {
  FrameTone tone = viewing.tone.at(viewing.firstFrame + index, viewing.display);
  const auto* one = std::get_if<RadianceMap>(&a.colour);
  const auto* other = std::get_if<RadianceMap>(&b.colour);
  Surroundings surroundings;
  if (one != nullptr && other != nullptr) surroundings = tone.around({one, other});
  if ((one == nullptr) != (other == nullptr)) surroundings = tone.around({one != nullptr ? one : other});
  return {std::move(tone), std::move(surroundings)};
}

EncodedMap encodedOf(const io::ImageFile& image, const Shown& shown) {
  if (const auto* radiance = std::get_if<RadianceMap>(&image.colour))
    return encodeForDisplay(*radiance, shown.tone, shown.surroundings);
  return std::get<EncodedMap>(image.colour).clone();
}

LuminanceMap luminanceOf(const io::ImageFile& image, const Viewing& viewing, const Shown& shown,
                         const std::filesystem::path& file) {
  if (!viewing.absolute) return displayLuminance(encodedOf(image, shown), viewing.display);
  if (image.luminance.empty()) {
    throw InputError(file.string(), "--absolute: expected a channel Y (luminance in cd/m2), found none");
  }
  // The metric needs light everywhere; nobody sees a difference below this.
  constexpr float kDarkest = 1e-4f;
  LuminanceMap luminances = image.luminance.clone();
  for (int y = 0; y < luminances.height(); ++y) {
    for (int x = 0; x < luminances.width(); ++x) {
      float& l = luminances(x, y);
      if (!std::isfinite(l)) {
        throw InputError(file.string(), "pixel (" + std::to_string(x) + ", " + std::to_string(y) +
                                            "): expected a finite luminance, found " + std::to_string(l));
      }
      if (l < kDarkest) l = kDarkest;
    }
  }
  return luminances;
}

VelocityMap Motion::next(const io::ImageFile& test, const io::ImageFile& reference, bool last) {
  if (viewing_.velocity) return VelocityMap(test.size(), *viewing_.velocity);
  PixelFlow toNext = meanFlow(test.flowToNext, reference.flowToNext);
  PixelFlow toPrevious = previous_.empty() ? PixelFlow() : flowToPrevious(previous_);
  previous_ = toNext.clone();
  if (last && !toPrevious.empty() && isStill(toNext)) toNext = PixelFlow();
  if (toNext.empty() && toPrevious.empty()) return VelocityMap();
  return ibr::imageVelocity(toPrevious, toNext, viewing_.framesPerSecond, viewing_.pixelsPerDegree);
}

}  // namespace promenade::app
