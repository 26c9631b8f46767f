#pragma once
// The samples of one frame as seen by another: where each appears, how large, and whether it is seen at all.

#include <glm/vec2.hpp>
#include <optional>

#include "ibr/reprojection.h"
#include "ibr/sight.h"
#include "src/core/frame.h"

namespace promenade::ibr {

/// A sample of `from`, in the image of `to`.
struct ProjectedSample {
  Sighting sighting;
  glm::vec2 position{};  ///< pixels of `to`; meaningful where the sighting is inside
  /// How many samples of `to` it covers; not > 0 (edge-on not a number): its surface is seen from behind.
  float area = 0.0f;
};

/// Keeps references to both.
class SampleProjection {
 public:
  SampleProjection(const Visibility& from, const Visibility& to, double creaseDegrees);

  [[nodiscard]] ProjectedSample operator()(int x, int y) const;

  /// Where sample (x, y) appears in the image of `to`, or beside it; nothing behind the eye.
  [[nodiscard]] std::optional<glm::vec2> position(int x, int y) const;

  /// How far a reflection of something infinitely far slides over the surface at the sample from the one
  /// frame to the other, in pixels of `to`: the part of the motion that turning the camera does not explain.
  [[nodiscard]] float slide(int x, int y) const;

 private:
  [[nodiscard]] float inverseDepth(int x, int y) const;

  const Visibility& from_;
  Reprojection reproject_;
  RayBasis rays_;
  Sight sight_;
  glm::vec3 eyeShift_;  ///< from the eye of `to` to that of `from`
  float focalRatioSquared_;
};

}  // namespace promenade::ibr
