#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/geometric.hpp>
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

}  // namespace

class SampleGather::Gather {
 public:
  Gather(const Frame& source, const Visibility& target, const Mask& wanted, const WarpSettings& settings)
      : source_(source),
        wanted_(wanted),
        target_(target),
        targetRays_(target.camera),
        targetSize_(target.camera.size()),
        footprintLimit_(settings.footprintLimit),
        grazingCosine_(static_cast<float>(settings.grazingCosine)),
        surface_(source, target.camera.pose().eye, settings.creaseDegrees),
        lookup_(source, target, settings) {}

  [[nodiscard]] WarpedSample operator()(int x, int y) const {
    if (!wanted_.empty() && wanted_(x, y) == 0) return {};
    const Found found = lookup_(x, y);
    WarpedSample sample{found.validity, found.footprint};
    if (found.validity == Validity::kValid || found.validity == Validity::kUndersampled) {
      if (isGrazing(x, y) && !isAmidAgreeing(found)) sample.validity = Validity::kUndersampled;
      const LayeredRadiance radiance = reconstruct(found.at, found.point);
      sample.diffuse = radiance.diffuse;
      sample.viewDependent = radiance.viewDependent;
    }
    return sample;
  }
  [[nodiscard]] Size size() const { return targetSize_; }
  [[nodiscard]] double footprintLimit() const { return footprintLimit_; }
  [[nodiscard]] glm::dvec3 eye() const { return source_.visibility.camera.pose().eye; }

 private:
  [[nodiscard]] bool isGrazing(int x, int y) const {
    if (grazingCosine_ == 0.0f || target_.item(x, y) == kNoItem) return false;
    const glm::vec3 ray = targetRays_.through(x, y);
    return std::abs(glm::dot(target_.normal(x, y), ray)) < grazingCosine_ * glm::length(ray);
  }
  /// Or on a sample.
  [[nodiscard]] bool isAmidAgreeing(const Found& found) const {
    if (found.at.fraction == glm::vec2(0.0f) || surface_.isSmoothBlock(found.at.x, found.at.y)) return true;
    return (usable(found.at, found.point) & kInnerNeighbours) == kInnerNeighbours;
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
  const Mask& wanted_;
  const Visibility& target_;
  RayBasis targetRays_;
  Size targetSize_;
  double footprintLimit_;
  float grazingCosine_;
  SourceSurface surface_;
  SourceLookup lookup_;
};

SampleGather::SampleGather(const Frame& source, const Visibility& target, const Mask& wanted,
                           const WarpSettings& settings) {
  requireSizes(target, "target");
  requireValid(source, settings);
  if (!wanted.empty()) requireSize(wanted.size(), target.camera.size(), "wanted samples");
  gather_ = std::make_unique<const Gather>(source, target, wanted, settings);
}

SampleGather::SampleGather(SampleGather&&) noexcept = default;
SampleGather& SampleGather::operator=(SampleGather&&) noexcept = default;
SampleGather::~SampleGather() = default;

WarpedSample SampleGather::operator()(int x, int y) const {
  return (*gather_)(x, y);
}

Size SampleGather::size() const {
  return gather_->size();
}

double SampleGather::footprintLimit() const {
  return gather_->footprintLimit();
}

glm::dvec3 SampleGather::eye() const {
  return gather_->eye();
}

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
  if (!(settings.grazingCosine >= 0.0 && settings.grazingCosine <= 1.0)) {
    throw InputError("warp: grazing cosine",
                     "expected a number in [0, 1], found " + std::to_string(settings.grazingCosine));
  }
}

Warped gatherWarp(const Frame& source, const Visibility& target, const Mask& wanted,
                  const WarpSettings& settings) {
  const SampleGather gather(source, target, wanted, settings);
  const Size size = target.camera.size();
  Warped warped{RadianceMap(size),
                RadianceMap(size),
                ValidityMap(size),
                decltype(Warped::footprint)(size),
                settings.footprintLimit,
                {},
                {},
                source.visibility.camera.pose().eye};
  tbb::parallel_for(0, size.height, [&](int y) {
    for (int x = 0; x < size.width; ++x) {
      const WarpedSample sample = gather(x, y);
      warped.diffuse(x, y) = sample.diffuse;
      warped.viewDependent(x, y) = sample.viewDependent;
      warped.validity(x, y) = sample.validity;
      warped.footprint(x, y) = sample.footprint;
    }
  });
  return warped;
}

Warped gatherWarp(const Frame& source, const Visibility& target, const WarpSettings& settings) {
  return gatherWarp(source, target, Mask(), settings);
}

}  // namespace promenade::ibr
