#pragma once
// How many paths a sample it takes until a viewer does not see the noise.

#include <cstdint>
#include <functional>
#include <memory>

#include "src/walkthrough/walkthrough.h"

namespace promenade::walkthrough {

/// Makes a renderer with so many paths a sample and this seed.
using RendererFactory = std::function<std::unique_ptr<Renderer>(int pathsPerSample, std::uint64_t seed)>;

struct NoiseSettings {
  double tolerancePercent = 1.0;  ///< of pixels with P > 0.75 between two renders with different seeds
  int fewestPaths = 16;
  int mostPaths = 1024;    ///< more would take days: better a warning
  int frames = 3;          ///< looked at, spread over the walk
  Size largest{320, 180};  ///< frames are looked at no larger than about this many pixels
};

struct NoiseVerdict {
  int pathsPerSample = 0;
  double worstPercent = 0.0;  ///< of the frames looked at, with that many paths
};

/// Doubles the paths until two renders of a frame with different seeds differ visibly on at most the
/// tolerated share of the pixels, in every frame looked at. The frames are rendered smaller than the walk's,
/// with the same supersampling and seen at the same pixels per degree: the noise of a pixel hardly depends on
/// how much of the scene the image shows. Still images, which show more than moving ones. The result is the
/// same for any number of threads.
[[nodiscard]] NoiseVerdict pathsForInvisibleNoise(const paths::CameraPath& path, const Settings& settings,
                                                  const RendererFactory& factory, const NoiseSettings& noise);

}  // namespace promenade::walkthrough
