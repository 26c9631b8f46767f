#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

#include "ibr/reconstruction.h"
#include "ibr/reprojection.h"
#include "ibr/source_surface.h"
#include "ibr/warp.h"
#include "src/core/errors.h"

namespace promenade::ibr {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

void requireSize(Size found, Size expected, const char* what) {
  if (found == expected) return;
  throw InputError(std::string("warp: ") + what,
                   "expected a map of the camera's " + std::to_string(expected.width) + "x" +
                       std::to_string(expected.height) + ", found " + std::to_string(found.width) + "x" +
                       std::to_string(found.height));
}

void requireSizes(const Visibility& visibility, const char* what) {
  const Size size = visibility.camera.size();
  requireSize(visibility.depth.size(), size, what);
  requireSize(visibility.normal.size(), size, what);
  requireSize(visibility.item.size(), size, what);
}

/// One target sample, fetched.
struct Fetched {
  Validity validity = Validity::kOutside;
  glm::vec2 position{kNaN};
  float footprint = kInfinity;
  LayeredRadiance radiance;
};

class Gather {
 public:
  Gather(const Frame& source, const Visibility& target, const WarpSettings& settings)
      : source_(source),
        target_(target),
        surface_(source, target.camera.pose().eye, settings.creaseDegrees),
        reproject_(target.camera, source.visibility.camera),
        targetRays_(target.camera),
        eyeShift_(target.camera.pose().eye - source.visibility.camera.pose().eye),
        footprintLimit_(static_cast<float>(settings.footprintLimit)) {
    const double focalRatio = target.camera.focalPixels() / source.visibility.camera.focalPixels();
    focalRatioSquared_ = static_cast<float>(focalRatio * focalRatio);
  }

  [[nodiscard]] Fetched operator()(int x, int y) const {
    Fetched fetched;
    const float depth = target_.depth(x, y);
    const glm::vec3 normal = target_.normal(x, y);
    const ItemId item = target_.item(x, y);
    const float inverseDepth = item == kNoItem ? 0.0f : 1.0f / depth;

    const glm::vec2 pixel(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
    const auto shift = reproject_(pixel, inverseDepth);
    if (!(shift.depthRatio > 0.0f)) return fetched;
    fetched.position = pixel + shift.pixels;
    fetched.footprint = footprint(targetRays_.through(x, y), normal, item, inverseDepth, shift.depthRatio);

    const glm::vec2 end(source_.diffuse.width(), source_.diffuse.height());
    const glm::vec2 position = fetched.position;
    if (!(position.x >= 0.0f && position.y >= 0.0f && position.x < end.x && position.y < end.y))
      return fetched;
    // From the shift alone: the fraction is exactly 0 for equal cameras, and rounds as finely far from the
    // corner.
    const glm::vec2 whole = glm::floor(shift.pixels);
    const Between at{x + static_cast<int>(whole.x), y + static_cast<int>(whole.y), shift.pixels - whole};
    const int nearestX = at.x + (at.fraction.x >= 0.5f ? 1 : 0);
    const int nearestY = at.y + (at.fraction.y >= 0.5f ? 1 : 0);
    if (!surface_.contains(nearestX, nearestY)) return fetched;

    SurfacePoint point;
    point.item = item;
    if (item != kNoItem) {
      point.fromSourceEye = depth * targetRays_.through(x, y) + eyeShift_;
      point.normal = normal;
      point.tolerance = surface_.tolerance(depth * shift.depthRatio);
    }
    fetched.validity = validity(nearestX, nearestY, point, fetched.footprint);
    if (fetched.validity == Validity::kValid) fetched.radiance = reconstruct(at, point);
    return fetched;
  }

 private:
  /// Area of a sample on the surface: z^2 / (f^2 |n.r|), r the ray with axis component 1, so that source over
  /// target is (zs / zt)^2 (ft / fs)^2 (n.rt) / (n.rs), with rs = (rt + (et - es) / zt) zt / zs. Solid angle
  /// of a sample: 1 / (f^2 |r|^3).
  [[nodiscard]] float footprint(const glm::vec3& ray, const glm::vec3& normal, ItemId item,
                                float inverseDepth, float depthRatio) const {
    if (item == kNoItem) return depthRatio * depthRatio * depthRatio * focalRatioSquared_;
    const float targetCosine = -glm::dot(normal, ray);
    const float sourceCosine = -glm::dot(normal, ray + eyeShift_ * inverseDepth);
    // Equal cameras see every surface alike, edge-on ones too.
    const float cosineRatio = targetCosine == sourceCosine ? 1.0f : targetCosine / sourceCosine;
    if (!(cosineRatio > 0.0f)) return kInfinity;
    return depthRatio * depthRatio * depthRatio * focalRatioSquared_ * cosineRatio;
  }

  [[nodiscard]] Validity validity(int nearestX, int nearestY, const SurfacePoint& point,
                                  float footprint) const {
    if (footprint == kInfinity || !surface_.agrees(nearestX, nearestY, point)) return Validity::kOccluded;
    if (!surface_.isTraced(nearestX, nearestY)) return Validity::kNotTraced;
    return footprint <= footprintLimit_ ? Validity::kValid : Validity::kUndersampled;
  }

  /// Precondition: the nearest sample agrees.
  [[nodiscard]] LayeredRadiance reconstruct(const Between& at, const SurfacePoint& point) const {
    // On a sample: that sample bit for bit.
    if (at.fraction == glm::vec2(0.0f))
      return {source_.diffuse(at.x, at.y), source_.viewDependent(at.x, at.y)};
    // All 16 lie on one smooth surface with the nearest.
    if (surface_.isSmoothBlock(at.x, at.y)) return catmullRom(source_, at);
    const Neighbours agreeing = usable(at, point);
    return (agreeing & kInnerNeighbours) == kInnerNeighbours ? catmullRomBesideEdge(source_, at, agreeing)
                                                             : linearFit(source_, at, agreeing);
  }

  [[nodiscard]] Neighbours usable(const Between& at, const SurfacePoint& point) const {
    unsigned found = 0;
    for (int k = 0; k < 16; ++k) {
      const int x = at.x - 1 + k % 4;
      const int y = at.y - 1 + k / 4;
      if (surface_.contains(x, y) && surface_.isTraced(x, y) && surface_.agrees(x, y, point))
        found |= 1U << k;
    }
    return static_cast<Neighbours>(found);
  }

  const Frame& source_;
  const Visibility& target_;
  SourceSurface surface_;
  Reprojection reproject_;
  RayBasis targetRays_;
  glm::vec3 eyeShift_;  ///< from the source's eye to the target's
  float focalRatioSquared_ = 1.0f;
  float footprintLimit_;
};

}  // namespace

void requireValid(const Frame& source, const WarpSettings& settings) {
  const Size size = source.visibility.camera.size();
  requireSizes(source.visibility, "source");
  requireSize(source.diffuse.size(), size, "source");
  requireSize(source.viewDependent.size(), size, "source");
  requireSize(source.source.size(), size, "source");
  if (!(settings.footprintLimit > 0.0)) {
    throw InputError("warp: footprint limit",
                     "expected a positive number, found " + std::to_string(settings.footprintLimit));
  }

  if (!(settings.creaseDegrees > 0.0 && settings.creaseDegrees <= 180.0)) {
    throw InputError("warp: crease angle",
                     "expected degrees in (0, 180], found " + std::to_string(settings.creaseDegrees));
  }
}

Warped gatherWarp(const Frame& source, const Visibility& target, const Mask& wanted,
                  const WarpSettings& settings) {
  const Size size = target.camera.size();
  requireSizes(target, "target");
  requireValid(source, settings);
  if (!wanted.empty()) requireSize(wanted.size(), size, "wanted samples");

  const Gather gather(source, target, settings);
  Warped warped{RadianceMap(size),
                RadianceMap(size),
                target.depth.clone(),
                target.item.clone(),
                ValidityMap(size),
                decltype(Warped::sourcePosition)(size),
                decltype(Warped::footprint)(size),
                settings.footprintLimit};
  tbb::parallel_for(0, size.height, [&](int y) {
    for (int x = 0; x < size.width; ++x) {
      Fetched fetched;
      fetched.validity = Validity::kNotWanted;
      if (wanted.empty() || wanted(x, y) != 0) fetched = gather(x, y);
      warped.diffuse(x, y) = fetched.radiance.diffuse;
      warped.viewDependent(x, y) = fetched.radiance.viewDependent;
      warped.validity(x, y) = fetched.validity;
      warped.sourcePosition(x, y) = fetched.position;
      warped.footprint(x, y) = fetched.footprint;
    }
  });
  return warped;
}

Warped gatherWarp(const Frame& source, const Visibility& target, const WarpSettings& settings) {
  return gatherWarp(source, target, Mask(), settings);
}

}  // namespace promenade::ibr
