#include "examples/hall/surface.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace promenade::hall {
namespace {

using glm::dvec2;
using glm::dvec3;

/// Indices of a grid of (columns + 1) x (rows + 1) vertices, row by row, that begins at vertex `first`.
void addGrid(std::vector<std::uint32_t>& indices, std::uint32_t first, int columns, int rows) {
  const auto stride = static_cast<std::uint32_t>(columns + 1);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const std::uint32_t a = first + static_cast<std::uint32_t>(j) * stride + static_cast<std::uint32_t>(i);
      const std::uint32_t b = a + 1, c = a + stride + 1, d = a + stride;
      indices.insert(indices.end(), {a, b, c, a, c, d});
    }
  }
}

/// Unit normal of a profile piece at point i: to the right of the direction of travel.
dvec2 profileNormal(const std::vector<dvec2>& piece, std::size_t i) {
  const dvec2 before = piece[i == 0 ? 0 : i - 1];
  const dvec2 after = piece[i + 1 == piece.size() ? i : i + 1];
  const dvec2 along = glm::normalize(after - before);
  return {along.y, -along.x};
}

}  // namespace

Surface& Surface::add(const Surface& other, const glm::dmat4& placement) {
  const auto first = static_cast<std::uint32_t>(positions.size());
  const glm::dmat3 linear(placement);
  const glm::dmat3 forNormals = glm::transpose(glm::inverse(linear));
  for (const dvec3& p : other.positions) positions.push_back(dvec3(placement * glm::dvec4(p, 1.0)));
  for (const dvec3& n : other.normals) normals.push_back(glm::normalize(forNormals * n));
  texCoords.insert(texCoords.end(), other.texCoords.begin(), other.texCoords.end());
  for (const std::uint32_t i : other.indices) indices.push_back(first + i);
  return *this;
}

Surface& Surface::addQuad(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d) {
  const auto first = static_cast<std::uint32_t>(positions.size());
  // The diagonals, so that a quadrilateral with one edge of length 0 has a normal too.
  const dvec3 n = glm::normalize(glm::cross(c - a, d - b));
  const dvec3 s = glm::normalize(glm::distance(a, b) > 1e-9 ? b - a : c - d);
  const dvec3 t = glm::cross(n, s);
  for (const dvec3& p : {a, b, c, d}) {
    positions.push_back(p);
    normals.push_back(n);
    texCoords.emplace_back(glm::dot(p - a, s), -glm::dot(p - a, t));
  }
  indices.insert(indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
  return *this;
}

Surface& Surface::scaleTexture(const dvec2& factor) {
  for (dvec2& t : texCoords) t *= factor;
  return *this;
}

Surface parametric(const Parametric& p, int columns, int rows, dvec2 textureScale) {
  Surface surface;
  constexpr double kStep = 1e-4;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double u = static_cast<double>(i) / columns;
      const double v = static_cast<double>(j) / rows;
      surface.positions.push_back(p(u, v));
      surface.texCoords.push_back(dvec2(u, v) * textureScale);
      // At a pole one derivative vanishes on the edge of the domain but not beside it.
      const double vn = std::min(std::max(v, 2.0 * kStep), 1.0 - 2.0 * kStep);
      const dvec3 du = p(u + kStep, vn) - p(u - kStep, vn);
      const dvec3 dv = p(u, vn + kStep) - p(u, vn - kStep);
      surface.normals.push_back(glm::normalize(glm::cross(du, dv)));
    }
  }
  addGrid(surface.indices, 0, columns, rows);
  return surface;
}

Profile& Profile::lineTo(dvec2 end) {
  pieces_.push_back({last_, end});
  last_ = end;
  return *this;
}

Profile& Profile::quarterTo(dvec2 end, Bulge bulge, int segments) {
  std::vector<dvec2> piece;
  for (int i = 0; i <= segments; ++i) {
    const double angle = 0.5 * glm::pi<double>() * i / segments;
    // Both run from 0 to 1; which of them runs ahead decides to which side the quarter bulges.
    const double fast = std::sin(angle), slow = 1.0 - std::cos(angle);
    const bool growing = end.x > last_.x;
    const bool xFirst = (bulge == Bulge::kOutward) == growing;
    piece.emplace_back(last_.x + (end.x - last_.x) * (xFirst ? fast : slow),
                       last_.y + (end.y - last_.y) * (xFirst ? slow : fast));
  }
  pieces_.push_back(piece);
  last_ = end;
  return *this;
}

Profile& Profile::curveThrough(const std::vector<dvec2>& points, int segmentsEach) {
  std::vector<dvec2> knots{last_};
  knots.insert(knots.end(), points.begin(), points.end());
  std::vector<dvec2> piece{last_};
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    const dvec2 p1 = knots[k], p2 = knots[k + 1];
    const dvec2 p0 = k == 0 ? 2.0 * p1 - p2 : knots[k - 1];
    const dvec2 p3 = k + 2 == knots.size() ? 2.0 * p2 - p1 : knots[k + 2];
    for (int i = 1; i <= segmentsEach; ++i) {
      const double t = static_cast<double>(i) / segmentsEach;
      piece.push_back(0.5 * (2.0 * p1 + (p2 - p0) * t + (2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3) * t * t +
                             (3.0 * p1 - p0 - 3.0 * p2 + p3) * t * t * t));
    }
  }
  pieces_.push_back(piece);
  last_ = knots.back();
  return *this;
}

Surface lathe(const Profile& profile, int segments) {
  Surface surface;
  double along = 0.0;
  for (const std::vector<dvec2>& piece : profile.pieces()) {
    const auto first = static_cast<std::uint32_t>(surface.positions.size());
    for (std::size_t j = 0; j < piece.size(); ++j) {
      if (j > 0) along += glm::distance(piece[j], piece[j - 1]);
      const dvec2 n = profileNormal(piece, j);
      for (int i = 0; i <= segments; ++i) {
        const double angle = 2.0 * glm::pi<double>() * i / segments;
        const dvec3 outward(std::sin(angle), 0.0, std::cos(angle));
        surface.positions.push_back(outward * piece[j].x + dvec3(0.0, piece[j].y, 0.0));
        surface.normals.push_back(outward * n.x + dvec3(0.0, n.y, 0.0));
        surface.texCoords.emplace_back(static_cast<double>(i) / segments, along);
      }
    }
    addGrid(surface.indices, first, segments, static_cast<int>(piece.size()) - 1);
  }
  return surface;
}

Surface extrude(const Profile& profile, double z0, double z1) {
  Surface surface;
  double along = 0.0;
  for (const std::vector<dvec2>& piece : profile.pieces()) {
    const auto first = static_cast<std::uint32_t>(surface.positions.size());
    for (std::size_t j = 0; j < piece.size(); ++j) {
      if (j > 0) along += glm::distance(piece[j], piece[j - 1]);
      const dvec2 n = profileNormal(piece, j);
      // Seen from outside (+X) with +Y up, +Z is to the left: the far end comes first.
      for (const double z : {z1, z0}) {
        surface.positions.emplace_back(piece[j].x, piece[j].y, z);
        surface.normals.emplace_back(n.x, n.y, 0.0);
        surface.texCoords.emplace_back(z, along);
      }
    }
    addGrid(surface.indices, first, 1, static_cast<int>(piece.size()) - 1);
  }
  return surface;
}

Surface frame(double width, double height, const std::vector<dvec2>& profile) {
  Surface surface;
  for (int side = 0; side < 4; ++side) {
    const bool horizontal = side % 2 == 0;
    const double halfLength = 0.5 * (horizontal ? width : height);
    const double halfAcross = 0.5 * (horizontal ? height : width);
    const glm::dmat4 turn = turned(0.5 * glm::pi<double>() * side, dvec3(0.0, 0.0, 1.0));
    Surface bar;
    for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
      const dvec2 p = profile[k], q = profile[k + 1];
      // The lower bar, from its inner to its outer edge; longer outside by the mitre.
      bar.addQuad({-halfLength - q.x, -halfAcross - q.x, q.y}, {halfLength + q.x, -halfAcross - q.x, q.y},
                  {halfLength + p.x, -halfAcross - p.x, p.y}, {-halfLength - p.x, -halfAcross - p.x, p.y});
    }
    surface.add(bar, turn);
  }
  return surface;
}

Surface sphere(double radius, int segments, int rings) {
  return parametric(
      [radius](double u, double v) {
        const double longitude = 2.0 * glm::pi<double>() * u, latitude = glm::pi<double>() * (v - 0.5);
        return radius * dvec3(std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                              std::cos(latitude) * std::cos(longitude));
      },
      segments, rings, {1.0, 1.0});
}

glm::dmat4 moved(const dvec3& by) {
  return glm::translate(glm::dmat4(1.0), by);
}

glm::dmat4 turned(double radians, const dvec3& axis, const dvec3& by) {
  return glm::rotate(moved(by), radians, axis);
}

}  // namespace promenade::hall
