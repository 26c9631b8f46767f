#pragma once
// Small things that every part of shading needs. Not part of the folder's public face.

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>

#include "src/core/image.h"

namespace promenade::render {

inline constexpr float kPi = std::numbers::pi_v<float>;
/// The largest number below 1.
inline constexpr float kOneBelow = 0.99999994f;

[[nodiscard]] inline float meanOf(const Rgb& v) {
  return (v.r + v.g + v.b) * (1.0f / 3.0f);
}

/// A unit direction at that cosine to the normal, local to the shading frame: for what does not depend on
/// azimuth.
[[nodiscard]] inline glm::vec3 directionAt(float cosine) {
  return {std::sqrt(std::max(0.0f, 1.0f - cosine * cosine)), 0.0f, cosine};
}

}  // namespace promenade::render
