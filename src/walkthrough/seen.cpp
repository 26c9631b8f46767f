#include "src/walkthrough/seen.h"

#include "src/core/resolve.h"

namespace promenade::walkthrough {

LuminanceMap seenOnDisplay(const Frame& samples, const Settings& settings) {
  const RadianceMap radiance = resolveRadiance(combinedRadiance(samples), settings.supersample);
  return displayLuminance(encodeForDisplay(radiance, settings.tone), settings.display);
}

}  // namespace promenade::walkthrough
