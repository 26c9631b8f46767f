#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace promenade::render {

/// Duff et al., Building an Orthonormal Basis, Revisited (JCGT 6(1), 2017).
struct Basis {
  glm::vec3 x, y, z;
  explicit Basis(const glm::vec3& normal) : z(normal) {
    const float sign = std::copysign(1.0f, z.z);
    const float a = -1.0f / (sign + z.z);
    const float b = z.x * z.y * a;
    x = {1.0f + sign * z.x * z.x * a, sign * b, -sign * z.x};
    y = {b, sign + z.y * z.y * a, -z.y};
  }
  [[nodiscard]] glm::vec3 toLocal(const glm::vec3& w) const {
    return {glm::dot(w, x), glm::dot(w, y), glm::dot(w, z)};
  }
  [[nodiscard]] glm::vec3 toWorld(const glm::vec3& l) const { return l.x * x + l.y * y + l.z * z; }
};

}  // namespace promenade::render
