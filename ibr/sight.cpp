#include "ibr/sight.h"

#include <cmath>
#include <glm/common.hpp>
#include <numbers>

namespace promenade::ibr {

Sight::Sight(const Visibility& visibility, const glm::dvec3& otherEye, double creaseDegrees)
    : visibility_(visibility),
      rays_(visibility.camera),
      tolerance_(visibility.camera, otherEye),
      creaseCosine_(static_cast<float>(std::cos(creaseDegrees * std::numbers::pi / 180.0))) {}

Sight::Relation Sight::relation(int x, int y, const SurfacePoint& point) const {
  const ItemId item = visibility_.item(x, y);
  if (item == kNoItem) return point.item == kNoItem ? Relation::kSame : Relation::kBehind;
  if (point.item == kNoItem) return Relation::kInFront;
  const glm::vec3& normal = visibility_.normal(x, y);
  const glm::vec3 chord = point.fromSourceEye - visibility_.depth(x, y) * rays_.through(x, y);
  const float beyondSample = -glm::dot(chord, normal);
  const float beforePoint = -glm::dot(chord, point.normal);
  if (item == point.item && glm::dot(normal, point.normal) >= creaseCosine_ &&
      std::abs(beyondSample + beforePoint) <= 2.0f * point.tolerance) {
    return Relation::kSame;
  }
  // In front: the point lies behind the tangent plane of the sample, and the sample before that of the point.
  // Of two faces that meet in an edge, each lies behind the other or each before the other: neither hides the
  // other, though one be nearer.
  if (beyondSample > point.tolerance && beforePoint > point.tolerance) return Relation::kInFront;
  if (beyondSample < -point.tolerance && beforePoint < -point.tolerance) return Relation::kBehind;
  return Relation::kBeside;
}

Sighting Sight::operator()(glm::vec2 pixel, const SurfacePoint& point) const {
  const Size size = visibility_.camera.size();
  Sighting sighting;
  // Also rules out what would not fit into an int.
  if (!(pixel.x >= -0.5f && pixel.y >= -0.5f && pixel.x < static_cast<float>(size.width) + 0.5f &&
        pixel.y < static_cast<float>(size.height) + 0.5f)) {
    return sighting;
  }
  sighting.isInside = true;
  const glm::vec2 corner = glm::floor(pixel - 0.5f);
  sighting.x = static_cast<int>(corner.x);
  sighting.y = static_cast<int>(corner.y);
  for (int k = 0; k < 4; ++k) {
    const int x = sighting.x + k % 2;
    const int y = sighting.y + k / 2;
    if (!visibility_.depth.contains(x, y)) continue;
    const Relation found = relation(x, y, point);
    if (found == Relation::kSame) sighting.agreeing = static_cast<std::uint8_t>(sighting.agreeing | 1U << k);
    if (found == Relation::kInFront) sighting.hiding = static_cast<std::uint8_t>(sighting.hiding | 1U << k);
  }
  return sighting;
}

}  // namespace promenade::ibr
