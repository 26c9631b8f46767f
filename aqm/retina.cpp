#include "aqm/retina.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "aqm/cortex.h"
#include "aqm/csf.h"

namespace promenade::aqm {

glm::dvec2 retinalVelocity(glm::dvec2 imageVelocity) {
  const double image = glm::length(imageVelocity);
  if (image == 0.0) {
    return {0.0, 0.0};
  }
  const double eye = std::min(0.82 * image + kDriftSpeed, 80.0);
  return imageVelocity * ((image - eye) / image);
}

double channelSpeed(glm::dvec2 retinal, int orientation) {
  const double speed = orientation == kUnoriented ? glm::length(retinal)
                                                  : std::abs(glm::dot(retinal, acrossBars(orientation)));
  return std::max(kDriftSpeed, speed);
}

}  // namespace promenade::aqm
