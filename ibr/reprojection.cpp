#include "ibr/reprojection.h"

#include <glm/matrix.hpp>

namespace promenade::ibr {
namespace {

glm::dvec2 axisPixel(const Camera& camera) {
  const Size size = camera.size();
  return glm::dvec2(0.5 * size.width, 0.5 * size.height) - camera.subpixelOffset();
}

}  // namespace

Reprojection::Reprojection(const Camera& from, const Camera& to)
    // to^T * from - 1 = to^T * (from - to) for orthonormal axes: exactly 0 when they are equal.
    : turn_(glm::transpose(to.pose().worldFromCamera) *
            (from.pose().worldFromCamera - to.pose().worldFromCamera)),
      move_(glm::transpose(to.pose().worldFromCamera) * (from.pose().eye - to.pose().eye)),
      fromFocal_(static_cast<float>(from.focalPixels())),
      toFocal_(static_cast<float>(to.focalPixels())),
      focalChange_(static_cast<float>(to.focalPixels() - from.focalPixels())),
      inverseFromFocal_(static_cast<float>(1.0 / from.focalPixels())),
      fromCentre_(axisPixel(from)),
      centreShift_(axisPixel(to) - axisPixel(from)) {}

}  // namespace promenade::ibr
