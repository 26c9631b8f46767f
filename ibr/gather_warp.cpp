#include <tbb/parallel_for.h>

#include <string>

#include "ibr/reconstruction.h"
#include "ibr/source_lookup.h"
#include "ibr/source_surface.h"
#include "ibr/warp.h"
#include "src/core/errors.h"

namespace promenade::ibr {
namespace {

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
  Found found;
  LayeredRadiance radiance;
};

class Gather {
 public:
  Gather(const Frame& source, const Visibility& target, const WarpSettings& settings)
      : source_(source),
        surface_(source, target.camera.pose().eye, settings.creaseDegrees),
        lookup_(source, target, settings) {}

  [[nodiscard]] Fetched operator()(int x, int y) const {
    Fetched fetched{lookup_(x, y), {}};
    const Found& found = fetched.found;
    if (found.validity == Validity::kValid || found.validity == Validity::kUndersampled) {
      fetched.radiance = reconstruct(found.at, found.point);
    }
    return fetched;
  }

 private:
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
  SourceSurface surface_;
  SourceLookup lookup_;
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
                ValidityMap(size),
                decltype(Warped::footprint)(size),
                settings.footprintLimit,
                {},
                {}};
  tbb::parallel_for(0, size.height, [&](int y) {
    for (int x = 0; x < size.width; ++x) {
      Fetched fetched;
      fetched.found.validity = Validity::kNotWanted;
      if (wanted.empty() || wanted(x, y) != 0) fetched = gather(x, y);
      warped.diffuse(x, y) = fetched.radiance.diffuse;
      warped.viewDependent(x, y) = fetched.radiance.viewDependent;
      warped.validity(x, y) = fetched.found.validity;
      warped.footprint(x, y) = fetched.found.footprint;
    }
  });
  return warped;
}

Warped gatherWarp(const Frame& source, const Visibility& target, const WarpSettings& settings) {
  return gatherWarp(source, target, Mask(), settings);
}

}  // namespace promenade::ibr
