#include "ibr/surface_patches.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace promenade::ibr {
namespace {

// Relative change of depth with the direction, beyond which a tangent plane says nothing about the surface:
// 84 degrees.
constexpr float kSteepestSlope = 10.0f;

glm::vec2 centreOf(glm::ivec2 sample) {
  return glm::vec2(sample) + 0.5f;
}

}  // namespace

SurfacePatches::SurfacePatches(const Frame& source, const Camera& target, double creaseDegrees)
    : visibility_(source.visibility),
      surface_(source, target.pose().eye, creaseDegrees),
      rays_(source.visibility.camera),
      reproject_(source.visibility.camera, target) {}

SurfacePatches::SourcePoint SurfacePatches::centre(glm::ivec2 sample) const {
  const bool background = visibility_.item(sample.x, sample.y) == kNoItem;
  return {centreOf(sample), background ? 0.0f : 1.0f / visibility_.depth(sample.x, sample.y)};
}

SurfacePatches::SourcePoint SurfacePatches::onTangentPlane(glm::ivec2 sample, glm::vec2 offset) const {
  SourcePoint point = centre(sample);
  point.pixel += offset;
  const glm::vec3& normal = visibility_.normal(sample.x, sample.y);
  // 1/z is proportional to n.r. A surface seen almost edge-on (the rim of a ball) is not followed all the way
  // its tangent plane goes.
  const float here = glm::dot(normal, rays_.through(sample.x, sample.y));
  const float change = glm::dot(normal, rays_.across(offset));
  const float most = kSteepestSlope * glm::length(rays_.across(offset));
  if (here != 0.0f) point.inverseDepth *= 1.0f + std::clamp(change / here, -most, most);
  return point;
}

bool SurfacePatches::joined(glm::ivec2 sample, glm::ivec2 other) const {
  return surface_.contains(sample.x, sample.y) && surface_.contains(other.x, other.y) &&
         surface_.agrees(other.x, other.y, surface_.pointOf(sample.x, sample.y));
}

void SurfacePatches::add(Patches& patches, const std::array<SourcePoint, 3>& points, const glm::vec3& normal,
                         ItemId item) const {
  Patch patch{{}, normal, item};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto shift = reproject_(points[i].pixel, points[i].inverseDepth);
    if (!(shift.depthRatio > 0.0f)) return;
    patch.corners[i] = {points[i].pixel + shift.pixels, points[i].inverseDepth / shift.depthRatio};
  }
  patches.patch[patches.count++] = patch;
}

void SurfacePatches::addQuarter(Patches& patches, glm::ivec2 sample, glm::ivec2 toward) const {
  const auto edge = [&](glm::ivec2 step) {
    const glm::ivec2 other = sample + step;
    const glm::vec2 half = 0.5f * glm::vec2(step);
    if (!joined(sample, other)) return onTangentPlane(sample, half);
    // Half way along the edge that both samples share.
    return SourcePoint{centreOf(sample) + half,
                       0.5f * (centre(sample).inverseDepth + centre(other).inverseDepth)};
  };
  const SourcePoint middle = centre(sample);
  const SourcePoint across = edge({toward.x, 0});
  const SourcePoint corner = onTangentPlane(sample, 0.5f * glm::vec2(toward));
  const SourcePoint along = edge({0, toward.y});
  const glm::vec3& normal = visibility_.normal(sample.x, sample.y);
  const ItemId item = visibility_.item(sample.x, sample.y);
  add(patches, {middle, across, corner}, normal, item);
  add(patches, {middle, corner, along}, normal, item);
}

SurfacePatches::Patches SurfacePatches::cell(int x, int y) const {
  Patches patches;
  const std::array<glm::ivec2, 4> samples{{{x, y}, {x + 1, y}, {x, y + 1}, {x + 1, y + 1}}};
  const auto [a, b, c, d] = samples;
  if (joined(a, b) && joined(a, c) && joined(b, d) && joined(c, d)) {
    glm::vec3 normal(0.0f);
    for (const glm::ivec2 s : samples) normal += visibility_.normal(s.x, s.y);
    const ItemId item = visibility_.item(x, y);
    if (item != kNoItem) normal = glm::normalize(normal);
    add(patches, {centre(a), centre(b), centre(d)}, normal, item);
    add(patches, {centre(a), centre(d), centre(c)}, normal, item);
    return patches;
  }
  for (const glm::ivec2 s : samples) {
    if (!surface_.contains(s.x, s.y)) continue;
    addQuarter(patches, s, {s.x == x ? 1 : -1, s.y == y ? 1 : -1});
  }
  return patches;
}

}  // namespace promenade::ibr
