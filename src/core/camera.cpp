#include "src/core/camera.h"

#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace promenade {

Camera::Camera(const Pose& pose, double verticalFieldOfView, Size size, glm::dvec2 subpixelOffset)
    : pose_(pose),
      verticalFieldOfView_(verticalFieldOfView),
      size_(size),
      subpixelOffset_(subpixelOffset),
      focalPixels_(0.5 * size.height / std::tan(0.5 * verticalFieldOfView)) {
  assert(size.width >= 1 && size.height >= 1);
  assert(verticalFieldOfView > 0.0 && verticalFieldOfView < 3.14159265358979);
}

glm::dvec3 Camera::direction(glm::dvec2 pixel) const {
  const double x = (pixel.x + subpixelOffset_.x - 0.5 * size_.width) / focalPixels_;
  const double y = (pixel.y + subpixelOffset_.y - 0.5 * size_.height) / focalPixels_;
  return pose_.worldFromCamera * glm::dvec3(x, -y, -1.0);
}

glm::dvec3 Camera::pointAt(glm::dvec2 pixel, double depthMetres) const {
  return pose_.eye + depthMetres * direction(pixel);
}

std::optional<Projection> Camera::projectLocal(const glm::dvec3& local) const {
  const double depth = -local.z;
  if (!(depth > 0.0)) return std::nullopt;
  const glm::dvec2 pixel(0.5 * size_.width + focalPixels_ * local.x / depth - subpixelOffset_.x,
                         0.5 * size_.height - focalPixels_ * local.y / depth - subpixelOffset_.y);
  return Projection{pixel, depth};
}

std::optional<Projection> Camera::project(const glm::dvec3& worldPoint) const {
  return projectLocal(glm::transpose(pose_.worldFromCamera) * (worldPoint - pose_.eye));
}

std::optional<glm::dvec2> Camera::projectDirection(const glm::dvec3& worldDirection) const {
  const auto projection = projectLocal(glm::transpose(pose_.worldFromCamera) * worldDirection);
  if (!projection) return std::nullopt;
  return projection->pixel;
}

Camera Camera::supersampled(int factor) const {
  assert(factor >= 1);
  return Camera(pose_, verticalFieldOfView_, Size{size_.width * factor, size_.height * factor},
                subpixelOffset_ * static_cast<double>(factor));
}

Camera Camera::withSubpixelOffset(glm::dvec2 offset) const {
  return Camera(pose_, verticalFieldOfView_, size_, offset);
}

}  // namespace promenade
