#pragma once

#include <cmath>
#include <glm/geometric.hpp>

namespace promenade::ibr {

/// Radians in [0, pi] between two directions of any length > 0; exact for small angles, where the arc cosine
/// is not.
[[nodiscard]] inline float angleBetween(const glm::vec3& a, const glm::vec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace promenade::ibr
