#pragma once
// A triangle cut into divisions^2 equal parts, by lines parallel to its edges. Not part of the folder's
// public face.

#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "src/render/surfaces.h"

namespace promenade::render {

/// Half of a parallelogram that is cut into divisions x divisions: the part with its right angle at (column,
/// row), or the opposite one.
struct TrianglePart {
  std::uint32_t column = 0, row = 0;
  bool isUpper = false;
};

inline std::uint32_t numberOf(const TrianglePart& part, std::uint32_t divisions) {
  return 2 * (part.row * divisions + part.column) + (part.isUpper ? 1 : 0);
}

inline TrianglePart partAt(std::uint32_t number, std::uint32_t divisions) {
  return {number / 2 % divisions, number / 2 / divisions, number % 2 == 1};
}

inline TrianglePart partOf(glm::vec2 barycentric, std::uint32_t divisions) {
  const glm::vec2 at = barycentric * static_cast<float>(divisions);
  const auto most = static_cast<float>(divisions - 1);
  const glm::vec2 cell = glm::clamp(glm::floor(at), 0.0f, most);
  const glm::vec2 inside = at - cell;
  return {static_cast<std::uint32_t>(cell.x), static_cast<std::uint32_t>(cell.y),
          inside.x + inside.y > 1.0f && cell.x + cell.y < most};
}

/// `inside`: barycentric within the part.
inline glm::vec2 barycentricAt(const TrianglePart& part, glm::vec2 inside, std::uint32_t divisions) {
  const glm::vec2 corner(part.column, part.row);
  return (part.isUpper ? corner + 1.0f - inside : corner + inside) / static_cast<float>(divisions);
}

inline glm::vec3 positionAt(const Surfaces::Corners& c, glm::vec2 barycentric) {
  return (1.0f - barycentric.x - barycentric.y) * c.a + barycentric.x * c.b + barycentric.y * c.c;
}

}  // namespace promenade::render
