#include "src/core/primaries.h"

#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>

namespace promenade {
namespace {

glm::dvec3 xyzOf(const glm::dvec2& chromaticity) {
  const double x = chromaticity.x;
  const double y = chromaticity.y;
  return {x / y, 1.0, (1.0 - x - y) / y};
}

glm::dmat3 lightsOf(const Primaries& p) {
  return {xyzOf(p.red), xyzOf(p.green), xyzOf(p.blue)};  // columns
}

/// How much of each light is in white.
glm::dvec3 sharesOf(const Primaries& p) {
  return glm::inverse(lightsOf(p)) * xyzOf(p.white);
}

// Cone responses of XYZ: Lam 1985 ("Bradford").
glm::dmat3 coneResponses() {
  return {0.8951, -0.7502, 0.0389, 0.2664, 1.7135, -0.0685, -0.1614, 0.0367, 1.0296};
}

glm::dmat3 diagonal(const glm::dvec3& d) {
  return {d.x, 0.0, 0.0, 0.0, d.y, 0.0, 0.0, 0.0, d.z};
}

}  // namespace

bool arePossible(const Primaries& p) {
  constexpr double kSmallest = 1e-6;
  for (const glm::dvec2& c : {p.red, p.green, p.blue, p.white}) {
    if (!(c.x >= 0.0 && c.y >= kSmallest && c.x + c.y <= 1.0)) return false;
  }
  const glm::dvec2 a = p.green - p.red;
  const glm::dvec2 b = p.blue - p.red;
  if (!(a.x * b.y - a.y * b.x > kSmallest || a.x * b.y - a.y * b.x < -kSmallest)) return false;
  const glm::dvec3 shares = sharesOf(p);
  return shares.x > 0.0 && shares.y > 0.0 && shares.z > 0.0;
}

glm::dmat3 xyzFromRgb(const Primaries& primaries) {
  return lightsOf(primaries) * diagonal(sharesOf(primaries));
}

glm::dmat3 rgbFromRec709(const Primaries& primaries) {
  const Primaries rec709;
  const glm::dmat3 cones = coneResponses();
  const glm::dvec3 gain = (cones * xyzOf(primaries.white)) / (cones * xyzOf(rec709.white));
  const glm::dmat3 adapted = glm::inverse(cones) * diagonal(gain) * cones;
  return glm::inverse(xyzFromRgb(primaries)) * adapted * xyzFromRgb(rec709);
}

}  // namespace promenade
