#include "src/scene/geometry.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace promenade::scene {
namespace {

// In double precision: the squares of single-precision coordinates overflow and vanish too soon.
glm::dvec3 areaVector(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
}

glm::vec3 normalizedOr(const glm::dvec3& vector, const glm::vec3& fallback) {
  const double length = glm::length(vector);
  return length > 0.0 && std::isfinite(length) ? glm::vec3(vector / length) : fallback;
}

constexpr glm::vec3 kUp{0.0f, 0.0f, 1.0f};

}  // namespace

std::vector<glm::uvec3> triangulate(std::span<const std::uint32_t> indices, Topology topology) {
  std::vector<glm::uvec3> triangles;
  const std::size_t count = topology == Topology::kTriangles ? indices.size() / 3
                            : indices.size() < 3             ? 0
                                                             : indices.size() - 2;
  triangles.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    glm::uvec3 triangle;
    switch (topology) {
      case Topology::kTriangles:
        triangle = {indices[3 * i], indices[3 * i + 1], indices[3 * i + 2]};
        break;
      case Topology::kTriangleStrip:
        triangle = {indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]};
        break;
      case Topology::kTriangleFan:
        triangle = {indices[i + 1], indices[i + 2], indices[0]};
        break;
    }
    if (triangle.x != triangle.y && triangle.y != triangle.z && triangle.z != triangle.x) {
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

glm::vec3 faceNormal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return normalizedOr(areaVector(a, b, c), kUp);
}

std::vector<glm::vec3> smoothNormals(std::span<const glm::vec3> positions,
                                     std::span<const glm::uvec3> triangles) {
  std::vector<glm::dvec3> sums(positions.size(), glm::dvec3(0.0));
  for (const glm::uvec3& triangle : triangles) {
    const glm::dvec3 area = areaVector(positions[triangle.x], positions[triangle.y], positions[triangle.z]);
    for (int corner = 0; corner < 3; ++corner) {
      sums[triangle[corner]] += area;
    }
  }
  std::vector<glm::vec3> normals;
  normals.reserve(sums.size());
  for (const glm::dvec3& sum : sums) {
    normals.push_back(normalizedOr(sum, kUp));
  }
  return normals;
}

glm::vec3 anyOrthogonal(const glm::vec3& normal) {
  const glm::vec3 axis =
      std::abs(normal.x) < 0.5f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
  return glm::normalize(glm::cross(axis, normal));
}

std::vector<glm::vec4> generateTangents(std::span<const glm::vec3> positions,
                                        std::span<const glm::vec3> normals,
                                        std::span<const glm::vec2> texCoords,
                                        std::span<const glm::uvec3> triangles,
                                        const glm::mat3& textureTransform) {
  std::vector<glm::dvec3> alongU(positions.size(), glm::dvec3(0.0));
  std::vector<glm::dvec3> alongV(positions.size(), glm::dvec3(0.0));
  const auto uv = [&](std::uint32_t vertex) {
    return glm::dvec2(textureTransform * glm::vec3(texCoords[vertex], 1.0f));
  };
  for (const glm::uvec3& triangle : triangles) {
    const glm::dvec3 edge1 = glm::dvec3(positions[triangle.y]) - glm::dvec3(positions[triangle.x]);
    const glm::dvec3 edge2 = glm::dvec3(positions[triangle.z]) - glm::dvec3(positions[triangle.x]);
    const glm::dvec2 delta1 = uv(triangle.y) - uv(triangle.x);
    const glm::dvec2 delta2 = uv(triangle.z) - uv(triangle.x);
    const double determinant = delta1.x * delta2.y - delta2.x * delta1.y;
    if (determinant == 0.0 || !std::isfinite(determinant)) {
      continue;
    }
    // Directions weighted by the triangle's area in space: only the sign of the determinant is kept.
    const double sign = determinant > 0.0 ? 1.0 : -1.0;
    const double area = glm::length(glm::cross(edge1, edge2));
    const glm::dvec3 u =
        glm::dvec3(normalizedOr(sign * (delta2.y * edge1 - delta1.y * edge2), glm::vec3(0.0f)));
    const glm::dvec3 v =
        glm::dvec3(normalizedOr(sign * (delta1.x * edge2 - delta2.x * edge1), glm::vec3(0.0f)));
    for (int corner = 0; corner < 3; ++corner) {
      alongU[triangle[corner]] += area * u;
      alongV[triangle[corner]] += area * v;
    }
  }
  std::vector<glm::vec4> tangents;
  tangents.reserve(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const glm::dvec3 normal(normals[i]);
    const glm::vec3 tangent =
        normalizedOr(alongU[i] - normal * glm::dot(normal, alongU[i]), anyOrthogonal(normals[i]));
    // The bitangent w * cross(N, T) points up in the image (glTF 2.0, 3.9.3), and v grows downwards.
    const double side = glm::dot(glm::cross(normal, glm::dvec3(tangent)), alongV[i]);
    tangents.emplace_back(tangent, side > 0.0 ? -1.0f : 1.0f);
  }
  return tangents;
}

}  // namespace promenade::scene
