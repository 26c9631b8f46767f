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

LuminanceMap seenOnDisplay(const RadianceMap& picture, int index, const Settings& settings,
                           const Surroundings& surroundings) {
  const FrameTone tone = settings.tone.at(index, settings.display);
  return displayLuminance(encodeForDisplay(picture, tone, surroundings), settings.display);
}

LuminanceMap seenOnDisplay(const Frame& samples, int index, const Settings& settings,
                           const Surroundings& surroundings) {
  return seenOnDisplay(resolveRadiance(combinedRadiance(samples), settings.supersample), index, settings,
                       surroundings);
}

Surroundings surroundingsOf(const RadianceMap& picture, int index, const Settings& settings) {
  const FrameTone tone = settings.tone.at(index, settings.display);
  if (!tone.asksForSurroundings()) return {};
  return tone.around({&picture});
}

Surroundings surroundingsOf(const Frame& samples, int index, const Settings& settings) {
  if (!settings.tone.at(index, settings.display).asksForSurroundings()) return {};
  return surroundingsOf(resolveRadiance(combinedRadiance(samples), settings.supersample), index, settings);
}

}  // namespace promenade::walkthrough
