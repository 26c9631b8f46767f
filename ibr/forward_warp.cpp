#include <tbb/parallel_for.h>

#include <utility>

#include "ibr/depth_raster.h"
#include "ibr/reprojection.h"
#include "ibr/warp.h"

namespace promenade::ibr {

Warped forwardWarp(const Frame& source, const Camera& target, const WarpSettings& settings) {
  requireValid(source, settings);
  Rastered found = raster(SurfacePatches(source, target, settings.creaseDegrees), target);
  Warped warped = gatherWarp(source, found.visibility, found.covered, settings);

  // Nothing is known where nothing fell, but whether the source looked that way at all: as for a point at
  // infinity.
  const Reprojection reproject(target, source.visibility.camera);
  const Size size = target.size();
  const glm::vec2 end(source.diffuse.width(), source.diffuse.height());
  tbb::parallel_for(0, size.height, [&](int y) {
    for (int x = 0; x < size.width; ++x) {
      if (found.covered(x, y) != 0) continue;
      const glm::vec2 pixel(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const auto shift = reproject(pixel, 0.0f);
      const glm::vec2 p = pixel + shift.pixels;
      const bool inside = shift.depthRatio > 0.0f && p.x >= 0.0f && p.y >= 0.0f && p.x < end.x && p.y < end.y;
      warped.validity(x, y) = inside ? Validity::kOccluded : Validity::kOutside;
    }
  });
  warped.depth = std::move(found.visibility.depth);
  warped.item = std::move(found.visibility.item);
  return warped;
}

}  // namespace promenade::ibr
