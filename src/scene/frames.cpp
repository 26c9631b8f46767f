#include "src/scene/frames.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "src/scene/geometry.h"

namespace promenade::scene {
namespace {

class FrameMaker {
 public:
  FrameMaker(Mesh mesh, const Gltf& gltf, const std::string& place, Budget& budget, Warnings& warnings)
      : mesh_(std::move(mesh)), gltf_(gltf), place_(place), budget_(budget), warnings_(warnings) {}

  [[nodiscard]] Mesh finish(const Material& material) {
    if (mesh_.normals.empty()) {
      unshareVertices();
    } else {
      repairNormals();
    }
    repairTangents();
    const std::optional<Texture>& map =
        material.normalTexture ? material.normalTexture : material.clearcoatNormalTexture;
    if (!map || !mesh_.tangents.empty()) {
      return std::move(mesh_);
    }
    const auto& texCoords = mesh_.texCoords[static_cast<std::size_t>(map->texCoord)];
    if (texCoords.empty()) {
      return std::move(mesh_);
    }
    budget_.chargeGeometry(mesh_.positions.size(), sizeof(glm::vec4) + 2 * sizeof(glm::dvec3));
    mesh_.tangents =
        generateTangents(mesh_.positions, mesh_.normals, texCoords, mesh_.triangles, map->transform);
    return std::move(mesh_);
  }

 private:
  template <class Vector>
  [[nodiscard]] std::vector<Vector> perCorner(const std::vector<Vector>& values) const {
    std::vector<Vector> result;
    if (values.empty()) {
      return result;
    }
    budget_.chargeGeometry(mesh_.triangles.size(), 3 * sizeof(Vector));
    result.reserve(mesh_.triangles.size() * 3);
    for (const glm::uvec3& triangle : mesh_.triangles) {
      for (int corner = 0; corner < 3; ++corner) {
        result.push_back(values[triangle[corner]]);
      }
    }
    return result;
  }

  /// Flat normals (glTF 2.0, 3.7.2.1): every triangle gets vertices of its own.
  void unshareVertices() {
    if (mesh_.triangles.size() > UINT32_MAX / 3) {
      gltf_.fail(place_, "has too many triangles to give them flat normals");
    }
    mesh_.positions = perCorner(mesh_.positions);
    for (auto& texCoords : mesh_.texCoords) {
      texCoords = perCorner(texCoords);
    }
    mesh_.colors = perCorner(mesh_.colors);
    budget_.chargeGeometry(mesh_.positions.size(), sizeof(glm::vec3));
    mesh_.normals.reserve(mesh_.positions.size());
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      const auto first = static_cast<std::uint32_t>(3 * i);
      mesh_.triangles[i] = {first, first + 1, first + 2};
      const glm::vec3 normal =
          faceNormal(mesh_.positions[first], mesh_.positions[first + 1], mesh_.positions[first + 2]);
      mesh_.normals.insert(mesh_.normals.end(), 3, normal);
    }
  }

  void repairNormals() {
    std::vector<glm::vec3> replacements;
    for (std::size_t i = 0; i < mesh_.normals.size(); ++i) {
      const double length = glm::length(glm::dvec3(mesh_.normals[i]));
      if (length > 0.0 && std::isfinite(length)) {
        mesh_.normals[i] = glm::vec3(glm::dvec3(mesh_.normals[i]) / length);
        continue;
      }
      if (replacements.empty()) {
        warnings_.add(place_ + ".attributes.NORMAL" +
                      ": found normals without a direction; they are made from the triangles");
        replacements = smoothNormals(mesh_.positions, mesh_.triangles);
      }
      mesh_.normals[i] = replacements[i];
    }
  }

  void repairTangents() {
    for (std::size_t i = 0; i < mesh_.tangents.size(); ++i) {
      const glm::dvec3 tangent(mesh_.tangents[i]);
      const double length = glm::length(tangent);
      const bool good = length > 0.0 && std::isfinite(length);
      mesh_.tangents[i] = glm::vec4(good ? glm::vec3(tangent / length) : anyOrthogonal(mesh_.normals[i]),
                                    mesh_.tangents[i].w < 0.0f ? -1.0f : 1.0f);
    }
  }

  Mesh mesh_;
  const Gltf& gltf_;
  const std::string& place_;
  Budget& budget_;
  Warnings& warnings_;
};

}  // namespace

Mesh finishFrames(Mesh mesh, const Material& material, const Gltf& gltf, const std::string& place,
                  Budget& budget, Warnings& warnings) {
  return FrameMaker(std::move(mesh), gltf, place, budget, warnings).finish(material);
}

}  // namespace promenade::scene
