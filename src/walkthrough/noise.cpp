#include "src/walkthrough/noise.h"

#include <algorithm>
#include <cmath>

#include "src/core/resolve.h"

namespace promenade::walkthrough {
namespace {

LuminanceMap seen(const Renderer& renderer, const Camera& camera, int frame, const Settings& settings) {
  const Frame samples = renderer.render(camera.supersampled(settings.supersample), frame);
  const RadianceMap radiance = resolveRadiance(combinedRadiance(samples), settings.supersample);
  return displayLuminance(encodeForDisplay(radiance, settings.tone), settings.display);
}

// The walk's shape, at most about as many pixels as `largest` has.
Size reduced(Size size, Size largest) {
  const double scale = std::sqrt(static_cast<double>(largest.area()) / static_cast<double>(size.area()));
  if (scale >= 1.0) return size;
  const auto side = [scale](int length) {
    return std::max(1, static_cast<int>(std::lround(length * scale)));
  };
  return {side(size.width), side(size.height)};
}

}  // namespace

NoiseVerdict pathsForInvisibleNoise(const paths::CameraPath& path, const Settings& settings,
                                    const RendererFactory& factory, const NoiseSettings& noise) {
  const Size size = reduced(settings.size, noise.largest);
  const aqm::Settings viewing{.pixelsPerDegree = settings.display.pixelsPerDegree()};
  const int count = std::min(noise.frames, settings.frames.count());
  NoiseVerdict verdict;
  for (int paths = noise.fewestPaths;; paths *= 2) {
    const auto first = factory(paths, 1);
    const auto second = factory(paths, 2);
    verdict = {paths, 0.0};
    for (int k = 0; k < count; ++k) {
      // The middles of `count` equal parts of the walk.
      const int frame = settings.frames.first + (2 * k + 1) * settings.frames.count() / (2 * count);
      const Camera camera = path.camera(frame, size);
      const aqm::Result difference =
          aqm::compare(seen(*first, camera, frame, settings), seen(*second, camera, frame, settings),
                       VelocityMap(), viewing);
      verdict.worstPercent =
          std::max(verdict.worstPercent, aqm::percentVisible(difference.probability, Mask()));
      if (verdict.worstPercent > noise.tolerancePercent) break;
    }
    if (verdict.worstPercent <= noise.tolerancePercent || paths > noise.mostPaths / 2) return verdict;
  }
}

}  // namespace promenade::walkthrough
