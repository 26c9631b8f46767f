#include "ibr/source_lookup.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace promenade::ibr {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace

SourceLookup::SourceLookup(const Visibility& source, const Visibility& target, const WarpSettings& settings)
    : source_(source),
      target_(target),
      surface_(source, target.camera.pose().eye, settings.creaseDegrees),
      reproject_(target.camera, source.camera),
      targetRays_(target.camera),
      eyeShift_(target.camera.pose().eye - source.camera.pose().eye),
      footprintLimit_(static_cast<float>(settings.footprintLimit)),
      viewDependent_(settings.viewDependent),
      halfCreaseCosine_(static_cast<float>(std::cos(settings.creaseDegrees * std::numbers::pi / 360.0))) {
  const double focalRatio = target.camera.focalPixels() / source.camera.focalPixels();
  focalRatioSquared_ = static_cast<float>(focalRatio * focalRatio);
}

SourceLookup::SourceLookup(const Frame& source, const Visibility& target, const WarpSettings& settings)
    : SourceLookup(source.visibility, target, settings) {
  traced_ = &source.source;
}

Found SourceLookup::operator()(int x, int y) const {
  Found found;
  const float depth = target_.depth(x, y);
  const ItemId item = target_.item(x, y);
  const float inverseDepth = item == kNoItem ? 0.0f : 1.0f / depth;

  const glm::vec2 pixel(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
  const auto shift = reproject_(pixel, inverseDepth);
  if (!(shift.depthRatio > 0.0f)) return found;
  found.position = pixel + shift.pixels;
  const glm::vec2 end(source_.depth.width(), source_.depth.height());
  const glm::vec2 position = found.position;
  if (!(position.x >= 0.0f && position.y >= 0.0f && position.x < end.x && position.y < end.y)) return found;
  // From the shift alone: the fraction is exactly 0 for equal cameras, and rounds as finely far from the
  // corner.
  const glm::vec2 whole = glm::floor(shift.pixels);
  found.at = {x + static_cast<int>(whole.x), y + static_cast<int>(whole.y), shift.pixels - whole};
  found.nearestX = found.at.x + (found.at.fraction.x >= 0.5f ? 1 : 0);
  found.nearestY = found.at.y + (found.at.fraction.y >= 0.5f ? 1 : 0);
  if (!surface_.contains(found.nearestX, found.nearestY)) return found;
  if (traced_ != nullptr && !isTraced((*traced_)(found.nearestX, found.nearestY))) {
    found.validity = Validity::kNotTraced;
    return found;
  }
  const glm::vec3 ray = targetRays_.through(x, y);
  const glm::vec3 normal = target_.normal(x, y);
  found.footprint = footprint(ray, normal, item, inverseDepth, shift.depthRatio);

  found.point.item = item;
  if (item != kNoItem) {
    found.point.fromSourceEye = depth * ray + eyeShift_;
    found.point.normal = normal;
    found.point.tolerance = surface_.tolerance(depth * shift.depthRatio);
  }
  if (found.footprint == kInfinity || !surface_.agrees(found.nearestX, found.nearestY, found.point) ||
      !facesAlike(found)) {
    found.validity = Validity::kOccluded;
  } else {
    found.validity = found.footprint <= footprintLimit_ ? Validity::kValid : Validity::kUndersampled;
  }
  return found;
}

bool SourceLookup::facesAlike(const Found& found) const {
  if (!viewDependent_ || !viewDependent_(found.point.item)) return true;
  return glm::dot(source_.normal(found.nearestX, found.nearestY), found.point.normal) >= halfCreaseCosine_;
}

/// Area of a sample on the surface: z^2 / (f^2 |n.r|), r the ray with axis component 1, so that source over
/// target is (zs / zt)^2 (ft / fs)^2 (n.rt) / (n.rs), with rs = (rt + (et - es) / zt) zt / zs. Solid angle
/// of a sample: 1 / (f^2 |r|^3).
float SourceLookup::footprint(const glm::vec3& ray, const glm::vec3& normal, ItemId item, float inverseDepth,
                              float depthRatio) const {
  if (item == kNoItem) return depthRatio * depthRatio * depthRatio * focalRatioSquared_;
  const float targetCosine = -glm::dot(normal, ray);
  const float sourceCosine = -glm::dot(normal, ray + eyeShift_ * inverseDepth);
  // Equal cameras see every surface alike, edge-on ones too.
  const float cosineRatio = targetCosine == sourceCosine ? 1.0f : targetCosine / sourceCosine;
  if (!(cosineRatio > 0.0f)) return kInfinity;
  return depthRatio * depthRatio * depthRatio * focalRatioSquared_ * cosineRatio;
}

}  // namespace promenade::ibr
