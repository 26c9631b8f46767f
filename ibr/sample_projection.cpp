#include "ibr/sample_projection.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace promenade::ibr {
namespace {

glm::vec2 centre(int x, int y) {
  return {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
}

}  // namespace

SampleProjection::SampleProjection(const Visibility& from, const Visibility& to, double creaseDegrees)
    : from_(from),
      reproject_(from.camera, to.camera),
      rays_(from.camera),
      sight_(to, from.camera.pose().eye, creaseDegrees),
      eyeShift_(from.camera.pose().eye - to.camera.pose().eye) {
  const double focalRatio = to.camera.focalPixels() / from.camera.focalPixels();
  focalRatioSquared_ = static_cast<float>(focalRatio * focalRatio);
}

float SampleProjection::inverseDepth(int x, int y) const {
  return from_.item(x, y) == kNoItem ? 0.0f : 1.0f / from_.depth(x, y);
}

ProjectedSample SampleProjection::operator()(int x, int y) const {
  ProjectedSample projected;
  const float inverse = inverseDepth(x, y);
  const auto shift = reproject_(centre(x, y), inverse);
  if (!(shift.depthRatio > 0.0f)) return projected;
  projected.position = centre(x, y) + shift.pixels;

  // Of a surface a sample covers z^2 / (f^2 |n.r|), r the ray with axis component 1, of the background the
  // solid angle 1 / (f^2 |r|^3) (gather_warp.cpp has the same ratio).
  SurfacePoint point;
  point.item = from_.item(x, y);
  float cosineRatio = 1.0f;
  if (point.item != kNoItem) {
    const glm::vec3 ray = rays_.through(x, y);
    point.normal = from_.normal(x, y);
    point.fromSourceEye = from_.depth(x, y) * ray + eyeShift_;
    point.tolerance = sight_.tolerance(from_.depth(x, y) * shift.depthRatio);
    const float here = -glm::dot(point.normal, ray);
    const float there = -glm::dot(point.normal, ray + eyeShift_ * inverse);
    cosineRatio = here == there ? 1.0f : there / here;
  }
  projected.sighting = sight_(projected.position, point);
  projected.area =
      focalRatioSquared_ * cosineRatio / (shift.depthRatio * shift.depthRatio * shift.depthRatio);
  return projected;
}

std::optional<glm::vec2> SampleProjection::position(int x, int y) const {
  const auto shift = reproject_(centre(x, y), inverseDepth(x, y));
  if (!(shift.depthRatio > 0.0f)) return std::nullopt;
  return centre(x, y) + shift.pixels;
}

float SampleProjection::slide(int x, int y) const {
  const auto ofSurface = reproject_(centre(x, y), inverseDepth(x, y));
  const auto ofDirection = reproject_(centre(x, y), 0.0f);
  return glm::length(ofSurface.pixels - ofDirection.pixels);
}

}  // namespace promenade::ibr
