#include "ibr/coverage.h"

#include <cassert>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace promenade::ibr {
namespace {

/// Square of a tenth of a sample: what is closer says no more.
constexpr float kLeastSquaredDistance = 0.01f;

}  // namespace

Coverage::Coverage(const Visibility& frame, std::span<const Visibility* const> others, double creaseDegrees)
    : frame_(frame), rays_(frame.camera) {
  witnesses_.reserve(others.size() + 1);
  witnesses_.push_back(witness(frame, frame, creaseDegrees));
  for (const Visibility* other : others) witnesses_.push_back(witness(frame, *other, creaseDegrees));
}

Coverage::Witness Coverage::witness(const Visibility& frame, const Visibility& asked, double creaseDegrees) {
  const glm::dvec3& eye = frame.camera.pose().eye;
  return {&asked, Reprojection(frame.camera, asked.camera), Sight(asked, eye, creaseDegrees),
          glm::vec3(eye - asked.camera.pose().eye)};
}

bool Coverage::reaches(int x, int y, glm::vec2 place) const {
  assert(frame_.item(x, y) != kNoItem);
  SurfacePoint point;
  point.item = frame_.item(x, y);
  point.normal = frame_.normal(x, y);
  const glm::vec3 centre = rays_.through(x, y);
  const glm::vec3 ray = centre + rays_.across(place - glm::vec2(x, y) - 0.5f);
  const float steepness = glm::dot(point.normal, centre) / glm::dot(point.normal, ray);
  // A plane that is seen edge-on would be anywhere a sample further.
  const float depth = frame_.depth(x, y) * (steepness > 0.5f && steepness < 2.0f ? steepness : 1.0f);

  float show = 0.0f;
  float showOther = 0.0f;
  for (const Witness& asked : witnesses_) {
    const auto shift = asked.reproject(place, 1.0f / depth);
    if (!(shift.depthRatio > 0.0f)) continue;
    const glm::vec2 position = place + shift.pixels;
    const glm::vec2 nearest = glm::floor(position);
    const Size size = asked.visibility->camera.size();
    if (!(nearest.x >= 0.0f && nearest.y >= 0.0f && nearest.x < static_cast<float>(size.width) &&
          nearest.y < static_cast<float>(size.height))) {
      continue;
    }
    point.fromSourceEye = depth * ray + asked.eyeShift;
    point.tolerance = asked.sight.tolerance(depth * shift.depthRatio);
    const glm::vec2 away = position - nearest - 0.5f;
    const float closeness = 1.0f / (glm::dot(away, away) + kLeastSquaredDistance);
    switch (asked.sight.relation(static_cast<int>(nearest.x), static_cast<int>(nearest.y), point)) {
      case Sight::Relation::kSame:
        show += closeness;
        break;
      case Sight::Relation::kBehind:
        showOther += closeness;
        break;
      case Sight::Relation::kBeside:
      case Sight::Relation::kInFront:
        break;
    }
  }
  return show > showOther || showOther == 0.0f;
}

}  // namespace promenade::ibr
