#include "src/render/surfaces.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "src/render/material_textures.h"

namespace promenade::render {
namespace {

/// A mesh of so few triangles costs less in the top-level hierarchy than an instance node does.
constexpr std::size_t kTinyMesh = 16;

glm::vec3 normalizedOr(const glm::vec3& v, const glm::vec3& otherwise) {
  const float squared = glm::dot(v, v);
  return squared > 0.0f && std::isfinite(squared) ? v / std::sqrt(squared) : otherwise;
}

template <class T>
T interpolate(const std::vector<T>& values, const glm::uvec3& t, const glm::vec3& weights) {
  return values[t.x] * weights.x + values[t.y] * weights.y + values[t.z] * weights.z;
}

}  // namespace

Surfaces::Surfaces(const Scene& scene, ShadowsThrough shadowsThrough)
    : scene_(scene), shadowsThrough_(shadowsThrough), textures_(std::make_unique<MaterialTextures>(scene)) {
  std::vector<std::size_t> uses(scene.meshes.size(), 0);
  for (const Instance& instance : scene.instances) ++uses[static_cast<std::size_t>(instance.mesh)];

  placements_.reserve(scene.instances.size());
  objectPositions_.resize(scene.meshes.size());
  std::size_t flatCount = 0;
  for (const Instance& instance : scene.instances) {
    Placement p;
    p.mesh = static_cast<std::uint32_t>(instance.mesh);
    const Mesh& mesh = scene.meshes[p.mesh];
    p.flattened = uses[p.mesh] == 1 || mesh.triangles.size() <= kTinyMesh;
    p.worldFromObject = instance.worldFromObject;
    const glm::mat3 linear(instance.worldFromObject[0], instance.worldFromObject[1],
                           instance.worldFromObject[2]);
    p.orientation = glm::determinant(linear) < 0.0f ? -1.0f : 1.0f;
    // The cofactor matrix: the inverse transpose up to the determinant, and defined where the placement is
    // singular.
    p.worldNormalFromObject =
        p.orientation * glm::mat3(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                                  glm::cross(linear[0], linear[1]));
    if (p.flattened) {
      p.firstPosition = flatCount;
      flatCount += mesh.positions.size();
    } else if (objectPositions_[p.mesh].empty()) {
      objectPositions_[p.mesh] = mesh.positions;
      objectPositions_[p.mesh].emplace_back(0.0f);  // Embree reads 16 bytes at the last position
    }
    placements_.push_back(p);
  }
  flatPositions_.reserve(flatCount + 1);
  for (const Placement& p : placements_) {
    if (!p.flattened) continue;
    for (const glm::vec3& position : scene.meshes[p.mesh].positions) {
      flatPositions_.push_back(p.worldFromObject * glm::vec4(position, 1.0f));
    }
  }
  flatPositions_.emplace_back(0.0f);

  filters_.resize(scene.meshes.size());
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const Mesh& mesh = scene.meshes[i];
    const Material& material = scene.materials[static_cast<std::size_t>(mesh.material)];
    FilterTarget& filter = filters_[i];
    filter.owner = this;
    filter.mesh = static_cast<std::uint32_t>(i);
    float alpha = material.baseColor.a;
    if (material.baseColorTexture) alpha *= textures_->leastAlpha(*material.baseColorTexture);
    for (const glm::vec4& color : mesh.colors) alpha = std::min(alpha, material.baseColor.a * color.a);
    const bool masked = material.alphaMode == AlphaMode::kMask && alpha < material.alphaCutoff;
    const bool blended = material.alphaMode == AlphaMode::kBlend && alpha < 1.0f;
    const bool pane = material.transmission > 0.0f &&
                      (material.thickness <= 0.0f || shadowsThrough_ == ShadowsThrough::kPanesAndSolids);
    filter.cutOut = masked || blended;
    filter.attenuates = masked || blended || pane;
  }
}

Surfaces::~Surfaces() = default;

Surfaces::Triangles Surfaces::triangles(std::size_t instance) const {
  const Placement& p = placements_[instance];
  const Mesh& mesh = scene_.meshes[p.mesh];
  const glm::vec3* positions =
      p.flattened ? flatPositions_.data() + p.firstPosition : objectPositions_[p.mesh].data();
  return {positions, mesh.positions.size(), mesh.triangles.data(), mesh.triangles.size(), &filters_[p.mesh]};
}

const Material& Surfaces::materialOf(std::size_t instance) const {
  const Mesh& mesh = scene_.meshes[placements_[instance].mesh];
  return scene_.materials[static_cast<std::size_t>(mesh.material)];
}

Surfaces::Corners Surfaces::corners(std::size_t instance, std::uint32_t triangle) const {
  const Placement& p = placements_[instance];
  const Mesh& mesh = scene_.meshes[p.mesh];
  const glm::uvec3 t = mesh.triangles[triangle];
  Corners corners;
  if (p.flattened) {
    const glm::vec3* positions = flatPositions_.data() + p.firstPosition;
    corners.a = positions[t.x];
    corners.b = positions[t.y];
    corners.c = positions[t.z];
  } else {
    corners.a = p.worldFromObject * glm::vec4(mesh.positions[t.x], 1.0f);
    corners.b = p.worldFromObject * glm::vec4(mesh.positions[t.y], 1.0f);
    corners.c = p.worldFromObject * glm::vec4(mesh.positions[t.z], 1.0f);
  }
  // A mirroring placement turns the winding round; the front stays the front (glTF 2.0, 3.7.4).
  corners.frontNormal = p.orientation * glm::cross(corners.b - corners.a, corners.c - corners.a);
  return corners;
}

SurfacePoint Surfaces::pointAt(const Hit& hit, const glm::vec3& direction) const {
  const Placement& p = placements_[hit.instance];
  const Mesh& mesh = scene_.meshes[p.mesh];
  const glm::uvec3 t = mesh.triangles[hit.triangle];
  const glm::vec3 weights(1.0f - hit.barycentric.x - hit.barycentric.y, hit.barycentric.x, hit.barycentric.y);

  glm::vec3 a, b, c;
  if (p.flattened) {
    const glm::vec3* positions = flatPositions_.data() + p.firstPosition;
    a = positions[t.x];
    b = positions[t.y];
    c = positions[t.z];
  } else {
    a = p.worldFromObject * glm::vec4(mesh.positions[t.x], 1.0f);
    b = p.worldFromObject * glm::vec4(mesh.positions[t.y], 1.0f);
    c = p.worldFromObject * glm::vec4(mesh.positions[t.z], 1.0f);
  }
  SurfacePoint point;
  point.instance = hit.instance;
  point.triangle = hit.triangle;
  point.material = mesh.material;
  point.edge1 = b - a;
  point.edge2 = c - a;
  point.position = weights.x * a + weights.y * b + weights.z * c;
  point.geometricNormal =
      normalizedOr(p.orientation * glm::cross(point.edge1, point.edge2), -glm::normalize(direction));
  point.frontFace = glm::dot(point.geometricNormal, direction) <= 0.0f;
  const glm::vec3 normal = p.worldNormalFromObject * interpolate(mesh.normals, t, weights);
  point.normal = normalizedOr(normal, point.geometricNormal);
  point.normalLength = glm::length(normal);
  if (!mesh.tangents.empty()) {
    const glm::vec4 tangent = interpolate(mesh.tangents, t, weights);
    const glm::vec3 world =
        glm::mat3(p.worldFromObject[0], p.worldFromObject[1], p.worldFromObject[2]) * glm::vec3(tangent);
    point.tangent = glm::vec4(normalizedOr(world, glm::vec3(0.0f)), mesh.tangents[t.x].w * p.orientation);
  }
  for (std::size_t set = 0; set < 2; ++set) {
    const std::vector<glm::vec2>& coordinates = mesh.texCoords[set];
    if (coordinates.empty()) continue;
    point.texCoord[set] = interpolate(coordinates, t, weights);
    point.texCoordEdge1[set] = coordinates[t.y] - coordinates[t.x];
    point.texCoordEdge2[set] = coordinates[t.z] - coordinates[t.x];
  }
  if (!mesh.colors.empty()) point.color = interpolate(mesh.colors, t, weights);
  return point;
}

}  // namespace promenade::render
