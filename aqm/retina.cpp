#include "aqm/retina.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "aqm/csf.h"

namespace promenade::aqm {

double slowestSpeed(Eye eye) {
  return eye == Eye::kStabilised ? kDriftSpeed / 16.0 : kDriftSpeed;
}

glm::dvec2 retinalVelocity(glm::dvec2 imageVelocity, Eye eye) {
  const double image = glm::length(imageVelocity);
  if (eye != Eye::kTracking || image == 0.0) {
    return imageVelocity;
  }
  const double pursuit = std::min(0.82 * image + kDriftSpeed, 80.0);
  return imageVelocity * ((image - pursuit) / image);
}

double channelSpeed(glm::dvec2 retinal, glm::dvec2 across, double slowest) {
  return std::max(slowest, std::abs(glm::dot(retinal, across)));
}

double channelSpeed(glm::dvec2 retinal, double slowest) {
  return std::max(slowest, glm::length(retinal));
}

double onsetSpeed(double onsetHertz, double cyclesPerDegree) {
  return onsetHertz / cyclesPerDegree;
}

}  // namespace promenade::aqm
