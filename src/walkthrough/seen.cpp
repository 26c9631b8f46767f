#include "src/walkthrough/seen.h"

#include "src/core/resolve.h"

namespace promenade::walkthrough {

LuminanceMap seenOnDisplay(const RadianceMap& picture, int index, const Settings& settings) {
  return displayLuminance(encodeForDisplay(picture, settings.tone.at(index, settings.display)),
                          settings.display);
}

LuminanceMap seenOnDisplay(const Frame& samples, int index, const Settings& settings) {
  return seenOnDisplay(resolveRadiance(combinedRadiance(samples), settings.supersample), index, settings);
}

LuminanceMap seenOnDisplay(const Frame& samples, int index, const Settings& settings,
                           const Surroundings& surroundings) {
  const RadianceMap picture = resolveRadiance(combinedRadiance(samples), settings.supersample);
  const FrameTone tone = settings.tone.at(index, settings.display);
  return displayLuminance(encodeForDisplay(picture, tone, surroundings), settings.display);
}

Surroundings surroundingsOf(const Frame& samples, int index, const Settings& settings) {
  const FrameTone tone = settings.tone.at(index, settings.display);
  if (!tone.asksForSurroundings()) return {};
  const RadianceMap picture = resolveRadiance(combinedRadiance(samples), settings.supersample);
  return tone.around({&picture});
}

}  // namespace promenade::walkthrough
