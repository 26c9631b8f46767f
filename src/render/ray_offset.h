#pragma once
// Ray origins that do not hit the surface they start from.
// Waechter, Binder, A Fast and Robust Method for Avoiding Self-Intersection (Ray Tracing Gems, 2019, ch. 6).

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>

namespace promenade::render {

/// `point` moved off the surface to the side that `normal` (unit) points to, by a few hundred units in the
/// last place.
[[nodiscard]] inline glm::vec3 offsetRayOrigin(const glm::vec3& point, const glm::vec3& normal) {
  constexpr float kNearZero = 1.0f / 32.0f;
  constexpr float kFloatScale = 1.0f / 65536.0f;
  constexpr float kIntScale = 256.0f;
  glm::vec3 result;
  for (int i = 0; i < 3; ++i) {
    const auto steps = static_cast<std::int32_t>(kIntScale * normal[i]);
    const auto bits = std::bit_cast<std::int32_t>(point[i]) + (point[i] < 0.0f ? -steps : steps);
    result[i] =
        std::abs(point[i]) < kNearZero ? point[i] + kFloatScale * normal[i] : std::bit_cast<float>(bits);
  }
  return result;
}

}  // namespace promenade::render
