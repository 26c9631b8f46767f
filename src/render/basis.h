#pragma once
// Frames around a normal, and directions in them.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>

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

/// A direction above the plane z = 0 with density z / pi; `u` in [0, 1)^2.
inline glm::vec3 sampleCosine(glm::vec2 u) {
  const float radius = std::sqrt(u.x);
  const float phi = 2.0f * std::numbers::pi_v<float> * u.y;
  return {radius * std::cos(phi), radius * std::sin(phi), std::sqrt(std::max(0.0f, 1.0f - u.x))};
}

}  // namespace promenade::render
