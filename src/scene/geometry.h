#pragma once
// Triangle topology and the vertex frames that a file may leave out. Pure functions.

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace promenade::scene {

enum class Topology { kTriangles, kTriangleStrip, kTriangleFan };

/// Triangles from indices (glTF 2.0, 3.7.2.1, winding as there). Triangles with a repeated index are dropped;
/// so is an unfinished last one.
[[nodiscard]] std::vector<glm::uvec3> triangulate(std::span<const std::uint32_t> indices, Topology topology);

/// Geometric unit normal of a triangle, counter-clockwise; +Z if it has no area.
[[nodiscard]] glm::vec3 faceNormal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// Unit normal of each vertex: its triangles' normals, weighted by area. +Z where there is none.
[[nodiscard]] std::vector<glm::vec3> smoothNormals(std::span<const glm::vec3> positions,
                                                   std::span<const glm::uvec3> triangles);

/// Tangents for normal mapping: of each vertex the average of its triangles' texture gradients, made
/// orthogonal to the normal (Lengyel, "Computing tangent space basis vectors for an arbitrary mesh"); w is
/// the handedness. An approximation of the MikkTSpace tangents that glTF names: it differs where vertices are
/// shared across mirrored or split texture charts. `textureTransform` is what the normal texture applies to
/// `texCoords`. All spans have the length of `positions`.
[[nodiscard]] std::vector<glm::vec4> generateTangents(std::span<const glm::vec3> positions,
                                                      std::span<const glm::vec3> normals,
                                                      std::span<const glm::vec2> texCoords,
                                                      std::span<const glm::uvec3> triangles,
                                                      const glm::mat3& textureTransform);

/// Some unit vector orthogonal to the unit vector `normal`.
[[nodiscard]] glm::vec3 anyOrthogonal(const glm::vec3& normal);

}  // namespace promenade::scene
