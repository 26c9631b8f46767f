#include "src/scene/skins.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

namespace promenade::scene {
namespace {

/// The matrix that blends the joints of one vertex; weights need not sum to one in files as they are.
glm::dmat4 blendedJoint(const Binding& binding, std::size_t vertex, const Joints& joints, const Gltf& gltf,
                        const std::string& place) {
  glm::dmat4 sum(0.0);
  double total = 0.0;
  for (std::size_t set = 0; set < binding.joints.size(); ++set) {
    for (int i = 0; i < 4; ++i) {
      const double weight = binding.weights[set][vertex][i];
      if (!(weight > 0.0) || !std::isfinite(weight)) {
        continue;
      }
      const float joint = binding.joints[set][vertex][i];
      if (!(joint >= 0.0f && joint < static_cast<float>(joints.size()))) {
        gltf.fail(place, "found joint " + std::to_string(joint) + ", but its skin has " +
                             std::to_string(joints.size()));
      }
      sum += weight * joints[static_cast<std::size_t>(joint)];
      total += weight;
    }
  }
  return total > 0.0 ? sum / total : joints.front();
}

glm::vec3 directionOr(const glm::dvec3& direction, const glm::vec3& fallback) {
  const double length = glm::length(direction);
  return length > 0.0 && std::isfinite(length) ? glm::vec3(direction / length) : fallback;
}

}  // namespace

SkinStore::SkinStore(const Gltf& gltf, const std::vector<PlacedNode>& nodes, const Accessors& accessors,
                     Warnings& warnings)
    : gltf_(gltf),
      nodes_(nodes),
      accessors_(accessors),
      warnings_(warnings),
      placedAt_(gltf.model.nodes.size(), -1) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    placedAt_[static_cast<std::size_t>(nodes[i].node)] = static_cast<int>(i);
  }
}

const Joints* SkinStore::joints(int skin, const std::string& place) {
  gltf_.checkIndex(skin, gltf_.skins.size(), place, "skin");
  const auto [found, isNew] = found_.try_emplace(skin);
  if (isNew) {
    found->second = find(skin);
  }
  return found->second ? &*found->second : nullptr;
}

std::optional<Joints> SkinStore::find(int skin) const {
  const SkinSource& source = gltf_.skins[static_cast<std::size_t>(skin)];
  const std::string place = at("skins", static_cast<std::size_t>(skin));
  std::vector<glm::dmat4> matrices;
  for (const int joint : source.joints) {
    const int placed = placedAt_[static_cast<std::size_t>(joint)];  // references were checked with the JSON
    if (placed < 0) {
      warnings_.add(place + ": its joints are not in the shown scene; its meshes are shown without it");
      return std::nullopt;
    }
    matrices.push_back(nodes_[static_cast<std::size_t>(placed)].worldFromNode);
  }
  if (matrices.empty()) {
    gltf_.fail(place + ".joints", "expected at least one");
  }
  if (source.inverseBindMatrices < 0) {
    return matrices;
  }
  const std::vector<glm::mat4> inverseBind =
      accessors_.readMat4(source.inverseBindMatrices, place + ".inverseBindMatrices");
  if (inverseBind.size() < matrices.size()) {
    gltf_.fail(place + ".inverseBindMatrices", "expected one for each of the " +
                                                   std::to_string(matrices.size()) + " joints, found " +
                                                   std::to_string(inverseBind.size()));
  }
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    matrices[i] = matrices[i] * glm::dmat4(inverseBind[i]);
  }
  return matrices;
}

Mesh poseMesh(Mesh mesh, const Binding& binding, const Joints& joints, const Gltf& gltf,
              const std::string& place) {
  std::vector<bool> mirrored(mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::dmat4 worldFromBind = blendedJoint(binding, i, joints, gltf, place);
    const glm::dmat3 linear(worldFromBind);
    const double determinant = glm::determinant(linear);
    mesh.positions[i] = glm::vec3(worldFromBind * glm::dvec4(mesh.positions[i], 1.0));
    mirrored[i] = determinant < 0.0;
    if (!mesh.normals.empty()) {
      // The inverse transpose up to a positive factor: normals of a joint of scale zero are left as they are.
      const glm::dvec3 normal = determinant != 0.0
                                    ? glm::transpose(glm::inverse(linear)) * glm::dvec3(mesh.normals[i])
                                    : glm::dvec3(mesh.normals[i]);
      mesh.normals[i] = directionOr(normal, mesh.normals[i]);
    }
    if (!mesh.tangents.empty()) {
      const glm::vec3 tangent =
          directionOr(linear * glm::dvec3(mesh.tangents[i]), glm::vec3(mesh.tangents[i]));
      mesh.tangents[i] = glm::vec4(tangent, mirrored[i] ? -mesh.tangents[i].w : mesh.tangents[i].w);
    }
  }
  for (glm::uvec3& triangle : mesh.triangles) {
    if (mirrored[triangle.x]) {
      std::swap(triangle.y, triangle.z);
    }
  }
  return mesh;
}

}  // namespace promenade::scene
