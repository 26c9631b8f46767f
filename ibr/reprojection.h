#pragma once
// Where a scene point seen by one camera appears in another, as a displacement.
// Source: McMillan 1997, the warping equation x' ~ d(x) P'^-1 (C - C') + P'^-1 P x, with generalised
// disparity d = 1 / depth. Departure: the equation is solved for x' - x, so that nothing cancels: two equal
// cameras give exactly 0, and float is precise to about 1e-7 focal lengths whatever the image position is.

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "src/core/camera.h"

namespace promenade::ibr {

class Reprojection {
 public:
  Reprojection(const Camera& from, const Camera& to);

  struct Shift {
    glm::vec2 pixels;  ///< from the position in `from` to that in `to`; meaningful only where depthRatio > 0
    float depthRatio;  ///< depth in `to` over depth in `from`; <= 0: behind the eye of `to`
  };
  /// `pixel` in `from`; `inverseDepth` 1/metres along its view axis, 0 for a point at infinity.
  [[nodiscard]] Shift operator()(glm::vec2 pixel, float inverseDepth) const {
    const float a = (pixel.x - fromCentre_.x) * inverseFromFocal_;
    const float b = (fromCentre_.y - pixel.y) * inverseFromFocal_;
    // The viewing direction is d = (a, b, -1); in `to` the point over its depth is d + turn * d + move /
    // depth.
    const glm::vec3 turned = turn_ * glm::vec3(a, b, -1.0f);
    const glm::vec3 change = turned + move_ * inverseDepth;
    const float depthRatio = 1.0f - change.z;
    const float x = (focalChange_ * a + toFocal_ * change.x + fromFocal_ * a * change.z) / depthRatio;
    const float y = (focalChange_ * b + toFocal_ * change.y + fromFocal_ * b * change.z) / depthRatio;
    return {{centreShift_.x + x, centreShift_.y - y}, depthRatio};
  }

 private:
  glm::mat3 turn_;  ///< toFromWorld * worldFromFrom - 1
  glm::vec3 move_;  ///< eye of `from` in the axes of `to`, relative to its eye
  float fromFocal_;
  float toFocal_;
  float focalChange_;
  float inverseFromFocal_;
  glm::vec2 fromCentre_;  ///< pixel position of the view axis in `from`
  glm::vec2 centreShift_;
};

}  // namespace promenade::ibr
