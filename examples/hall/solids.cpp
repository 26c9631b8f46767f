// Boxes, rods, tubes and walls with openings.

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "examples/hall/surface.h"

namespace promenade::hall {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr int kArchSegments = 24;

void addTriangle(Surface& surface, const dvec3& a, const dvec3& b, const dvec3& c) {
  const auto first = static_cast<std::uint32_t>(surface.positions.size());
  const dvec3 n = glm::normalize(glm::cross(b - a, c - a));
  for (const dvec3& p : {a, b, c}) {
    surface.positions.push_back(p);
    surface.normals.push_back(n);
    surface.texCoords.emplace_back(p.x, -p.y);
  }
  surface.indices.insert(surface.indices.end(), {first, first + 1, first + 2});
}

/// Adds a quadrilateral so that its front is on the side of `outward`.
void addFacing(Surface& surface, const dvec3& outward, std::array<dvec3, 4> corners) {
  if (glm::dot(glm::cross(corners[2] - corners[0], corners[3] - corners[1]), outward) < 0.0) {
    std::swap(corners[0], corners[1]);
    std::swap(corners[2], corners[3]);
  }
  surface.addQuad(corners[0], corners[1], corners[2], corners[3]);
}

dvec3 archPoint(const ArchOpening& opening, int i) {
  const double angle = glm::pi<double>() * (1.0 - static_cast<double>(i) / kArchSegments);
  return {opening.halfWidth * std::cos(angle), opening.springing + opening.halfWidth * std::sin(angle), 0.0};
}

}  // namespace

Surface box(const dvec3& low, const dvec3& high, double chamfer) {
  Surface surface;
  const dvec3 centre = 0.5 * (low + high), half = 0.5 * (high - low);
  const dvec3 inner = half - chamfer;
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    for (const double side : {-1.0, 1.0}) {
      dvec3 outward(0.0);
      outward[axis] = side;
      const auto corner = [&](double a, double b) {
        dvec3 p = centre;
        p[axis] += side * half[axis];
        p[next] += a * inner[next];
        p[last] += b * inner[last];
        return p;
      };
      addFacing(surface, outward, {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)});
      if (chamfer <= 0.0) continue;
      for (const double otherSide : {-1.0, 1.0}) {  // the edge between this face and the face of `next`
        dvec3 across = outward;
        across[next] = otherSide;
        const auto edge = [&](bool onThisFace, double b) {
          dvec3 p = centre;
          p[axis] += side * (onThisFace ? half[axis] : inner[axis]);
          p[next] += otherSide * (onThisFace ? inner[next] : half[next]);
          p[last] += b * inner[last];
          return p;
        };
        addFacing(surface, across, {edge(true, -1), edge(false, -1), edge(false, 1), edge(true, 1)});
      }
    }
  }
  if (chamfer > 0.0) {
    for (int corner = 0; corner < 8; ++corner) {
      const dvec3 sign((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0,
                       (corner & 4) != 0 ? 1.0 : -1.0);
      const dvec3 a = centre + sign * dvec3(half.x, inner.y, inner.z);
      const dvec3 b = centre + sign * dvec3(inner.x, half.y, inner.z);
      const dvec3 c = centre + sign * dvec3(inner.x, inner.y, half.z);
      if (sign.x * sign.y * sign.z > 0.0) {
        addTriangle(surface, a, b, c);
      } else {
        addTriangle(surface, a, c, b);
      }
    }
  }
  return surface;
}

Surface tube(const std::function<dvec3(double)>& curve, const std::function<double(double)>& radius,
             int segmentsAlong, int segmentsAround, Ends ends) {
  constexpr double kStep = 1e-4;
  const auto tangent = [&](double u) { return glm::normalize(curve(u + kStep) - curve(u - kStep)); };
  // Parallel transport: each frame is the previous one turned by as little as takes it to the new tangent.
  std::vector<dvec3> across(static_cast<std::size_t>(segmentsAlong) + 1);
  dvec3 t = tangent(0.0);
  across[0] = glm::normalize(glm::cross(t, std::abs(t.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0)));
  for (int i = 1; i <= segmentsAlong; ++i) {
    t = tangent(static_cast<double>(i) / segmentsAlong);
    const dvec3 previous = across[static_cast<std::size_t>(i) - 1];
    across[static_cast<std::size_t>(i)] = glm::normalize(previous - glm::dot(previous, t) * t);
  }
  // On a closed curve the last frame meets the first after an angle, which is spread over the length.
  double twist = 0.0;
  if (ends == Ends::kClosed) {
    const dvec3 side = glm::cross(tangent(0.0), across[0]);
    twist = std::atan2(glm::dot(across.back(), side), glm::dot(across.back(), across[0]));
  }
  Surface surface;
  for (int i = 0; i <= segmentsAlong; ++i) {
    const double u = static_cast<double>(i) / segmentsAlong;
    const dvec3 direction = tangent(u), a = across[static_cast<std::size_t>(i)], b = glm::cross(direction, a);
    const dvec3 centre = curve(u);
    const double r = radius(u);
    const double slope =
        (radius(u + kStep) - radius(u - kStep)) / glm::distance(curve(u + kStep), curve(u - kStep));
    for (int k = 0; k <= segmentsAround; ++k) {
      const double angle = 2.0 * glm::pi<double>() * k / segmentsAround - twist * u;
      const dvec3 outward = std::cos(angle) * a + std::sin(angle) * b;
      surface.positions.push_back(centre + r * outward);
      surface.normals.push_back(glm::normalize(outward - slope * direction));
      surface.texCoords.emplace_back(static_cast<double>(k) / segmentsAround, u);
    }
  }
  const auto stride = static_cast<std::uint32_t>(segmentsAround + 1);
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(segmentsAlong); ++i) {
    for (std::uint32_t k = 0; k + 1 < stride; ++k) {
      const std::uint32_t a = i * stride + k;
      surface.indices.insert(surface.indices.end(),
                             {a, a + 1, a + stride + 1, a, a + stride + 1, a + stride});
    }
  }
  return surface;
}

Surface rod(const dvec3& from, const dvec3& to, double radius, int segments) {
  const double length = glm::distance(from, to);
  const dvec3 up = (to - from) / length;
  const dvec3 side = glm::normalize(glm::cross(up, std::abs(up.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0)));
  const glm::dmat4 placement(glm::dvec4(side, 0.0), glm::dvec4(up, 0.0),
                             glm::dvec4(glm::cross(side, up), 0.0), glm::dvec4(from, 1.0));
  return Surface().add(
      lathe(Profile({0.0, 0.0}).lineTo({radius, 0.0}).lineTo({radius, length}).lineTo({0.0, length}),
            segments),
      placement);
}

Surface wallWithArch(double width, double bottom, double top, const ArchOpening& opening, double depth) {
  Surface surface;
  const double half = 0.5 * width, w = opening.halfWidth;
  const auto rectangle = [&](double x0, double y0, double x1, double y1) {
    if (x1 > x0 && y1 > y0) surface.addQuad({x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0});
  };
  rectangle(-half, bottom, -w, top);
  rectangle(w, bottom, half, top);
  rectangle(-w, bottom, w, opening.sill);
  const dvec3 back(0.0, 0.0, -depth);
  for (int i = 0; i < kArchSegments; ++i) {
    const dvec3 p = archPoint(opening, i), q = archPoint(opening, i + 1);
    surface.addQuad(p, q, {q.x, top, 0.0}, {p.x, top, 0.0});
    surface.addQuad(q, p, p + back, q + back);
  }
  const double y0 = std::max(opening.sill, bottom);
  const dvec3 a(-w, y0, 0.0), b(w, y0, 0.0), c(w, opening.springing, 0.0), d(-w, opening.springing, 0.0);
  if (opening.sill > bottom) surface.addQuad(a, b, b + back, a + back);
  surface.addQuad(b, c, c + back, b + back);
  surface.addQuad(d, a, a + back, d + back);
  // One texture grid over the face and around its edges into the reveal.
  for (std::size_t i = 0; i < surface.positions.size(); ++i) {
    const dvec3 p = surface.positions[i];
    surface.texCoords[i] = dvec2(p.x - p.z, -p.y - p.z);
  }
  return surface;
}

Surface archPane(const ArchOpening& opening) {
  Surface surface;
  const double w = opening.halfWidth;
  surface.addQuad({-w, opening.sill, 0}, {w, opening.sill, 0}, {w, opening.springing, 0},
                  {-w, opening.springing, 0});
  // A fan of few triangles: each is an emitter that the renderer has to choose among.
  constexpr int kStep = 3;
  for (int i = 0; i < kArchSegments; i += kStep) {
    addTriangle(surface, {0.0, opening.springing, 0.0}, archPoint(opening, i + kStep), archPoint(opening, i));
  }
  return surface;
}

}  // namespace promenade::hall
