#include "ibr/surface_patches.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace promenade::ibr {
namespace {

// Relative change of depth with the direction, beyond which a tangent plane says nothing about the surface:
// 84 degrees.
constexpr float kSteepestSlope = 10.0f;

constexpr unsigned kRight = 1;
constexpr unsigned kBelow = 2;

glm::vec2 centreOf(glm::ivec2 sample) {
  return glm::vec2(sample) + 0.5f;
}

}  // namespace

SurfacePatches::SurfacePatches(const Frame& source, const Camera& target, double creaseDegrees)
    : visibility_(source.visibility),
      surface_(source, target.pose().eye, creaseDegrees),
      rays_(source.visibility.camera),
      reproject_(source.visibility.camera, target),
      centres_(source.visibility.camera.size()),
      links_(source.visibility.camera.size()) {
  const auto agree = [&](glm::ivec2 sample, glm::ivec2 other) {
    return surface_.contains(other.x, other.y) &&
           surface_.agrees(other.x, other.y, surface_.pointOf(sample.x, sample.y));
  };
  tbb::parallel_for(0, links_.height(), [&](int y) {
    for (int x = 0; x < links_.width(); ++x) {
      centres_(x, y) = project(centre({x, y}));
      const unsigned right = agree({x, y}, {x + 1, y}) ? kRight : 0U;
      const unsigned below = agree({x, y}, {x, y + 1}) ? kBelow : 0U;
      links_(x, y) = static_cast<std::uint8_t>(right | below);
    }
  });
}

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

Corner SurfacePatches::project(const SourcePoint& point) const {
  const auto shift = reproject_(point.pixel, point.inverseDepth);
  if (!(shift.depthRatio > 0.0f)) return {point.pixel, -1.0f};
  return {point.pixel + shift.pixels, point.inverseDepth / shift.depthRatio};
}

bool SurfacePatches::joined(glm::ivec2 sample, glm::ivec2 other) const {
  const glm::ivec2 first = glm::min(sample, other);
  if (!surface_.contains(first.x, first.y)) return false;
  return (links_(first.x, first.y) & (sample.x != other.x ? kRight : kBelow)) != 0;
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
  const Corner& middle = centres_(sample.x, sample.y);
  const Corner corner = project(onTangentPlane(sample, 0.5f * glm::vec2(toward)));
  const glm::vec3& normal = visibility_.normal(sample.x, sample.y);
  const ItemId item = visibility_.item(sample.x, sample.y);
  patches.add({{middle, project(edge({toward.x, 0})), corner}, normal, item});
  patches.add({{middle, corner, project(edge({0, toward.y}))}, normal, item});
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
    const auto at = [&](glm::ivec2 sample) { return centres_(sample.x, sample.y); };
    patches.add({{at(a), at(b), at(d)}, normal, item});
    patches.add({{at(a), at(d), at(c)}, normal, item});
    return patches;
  }
  for (const glm::ivec2 s : samples) {
    if (!surface_.contains(s.x, s.y)) continue;
    addQuarter(patches, s, {s.x == x ? 1 : -1, s.y == y ? 1 : -1});
  }
  return patches;
}

}  // namespace promenade::ibr
