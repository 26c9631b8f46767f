#pragma once
// Would a target sample be found in a source, and where? What gatherWarp() fetches, and what a plan of
// keyframes counts before anything is traced, is decided here.

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "ibr/reconstruction.h"
#include "ibr/reprojection.h"
#include "ibr/source_surface.h"
#include "ibr/warp.h"

namespace promenade::ibr {

/// A target sample in the image of a source.
struct Found {
  Validity validity = Validity::kOutside;
  glm::vec2 position{std::numeric_limits<float>::quiet_NaN()};  ///< pixels in the source; NaN behind its eye
  float footprint = std::numeric_limits<float>::infinity();     ///< as Warped::footprint
  /// Meaningful only where kValid or kUndersampled: the source samples around, the nearest of them, and the
  /// point as the source sees it.
  Between at;
  int nearestX = 0;
  int nearestY = 0;
  SurfacePoint point;
};

/// Keeps references to both. The cameras may differ in everything, resolution too.
class SourceLookup {
 public:
  /// As if every sample of the source had been traced.
  SourceLookup(const Visibility& source, const Visibility& target, const WarpSettings& settings);
  /// Where the nearest sample of the source was warped itself: kNotTraced.
  SourceLookup(const Frame& source, const Visibility& target, const WarpSettings& settings);

  /// Precondition: sample (x, y) is in the target.
  [[nodiscard]] Found operator()(int x, int y) const;

 private:
  /// Whether the surface faces the same way there as at the target sample, as far as its item needs it.
  [[nodiscard]] bool facesAlike(const Found& found) const;
  [[nodiscard]] float footprint(const glm::vec3& ray, const glm::vec3& normal, ItemId item,
                                float inverseDepth, float depthRatio) const;

  const Visibility& source_;
  const Visibility& target_;
  const SourceMap* traced_ = nullptr;  ///< null: everything was
  SampledSurface surface_;
  Reprojection reproject_;
  RayBasis targetRays_;
  glm::vec3 eyeShift_;  ///< from the source's eye to the target's
  float focalRatioSquared_ = 1.0f;
  float footprintLimit_;
  std::function<bool(ItemId)> viewDependent_;
  float halfCreaseCosine_;
};

}  // namespace promenade::ibr
