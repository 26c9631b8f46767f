#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "src/scene/placement.h"
#include "src/scene/skins.h"
#include "src/scene/values.h"

namespace promenade::scene {
namespace {

/// The object transforms of EXT_mesh_gpu_instancing, or one identity where the node does not use it.
std::vector<glm::dmat4> objectTransforms(const Gltf& gltf, int nodeIndex, const Accessors& accessors,
                                         Budget& budget) {
  const tinygltf::Node& node = gltf.model.nodes[static_cast<std::size_t>(nodeIndex)];
  const std::string place = at("nodes", static_cast<std::size_t>(nodeIndex));
  const Fields attributes =
      extension(gltf, node.extensions, "EXT_mesh_gpu_instancing", place).object("attributes");
  if (!attributes) {
    return {glm::dmat4(1.0)};
  }
  const int translation = attributes.index("TRANSLATION", -1);
  const int rotation = attributes.index("ROTATION", -1);
  const int scale = attributes.index("SCALE", -1);
  std::size_t count = 0;
  for (const int accessor : {translation, rotation, scale}) {
    if (accessor < 0) {
      continue;
    }
    gltf.checkIndex(accessor, accessors.size(), attributes.place(), "accessor");
    if (count != 0 && accessors.count(accessor) != count) {
      gltf.fail(attributes.place(), "its accessors have different numbers of elements");
    }
    count = accessors.count(accessor);
  }
  if (count == 0) {
    return {glm::dmat4(1.0)};
  }
  budget.chargeInstances(count);
  budget.chargeGeometry(count, sizeof(glm::dmat4));
  std::vector<glm::dmat4> transforms(count, glm::dmat4(1.0));
  if (translation >= 0) {
    const auto values = accessors.readVec3(translation, attributes.place("TRANSLATION"));
    for (std::size_t i = 0; i < count; ++i) {
      transforms[i] = glm::translate(transforms[i], glm::dvec3(values[i]));
    }
  }
  if (rotation >= 0) {
    const auto values = accessors.readVec4(rotation, attributes.place("ROTATION"));
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dquat quaternion(values[i].w, values[i].x, values[i].y, values[i].z);
      const double length = glm::length(quaternion);
      if (!(length > 1e-6) || !std::isfinite(length)) {
        gltf.fail(attributes.place("ROTATION"), "quaternion " + std::to_string(i) + " has no direction");
      }
      transforms[i] = transforms[i] * glm::mat4_cast(quaternion / length);
    }
  }
  if (scale >= 0) {
    const auto values = accessors.readVec3(scale, attributes.place("SCALE"));
    for (std::size_t i = 0; i < count; ++i) {
      transforms[i] = glm::scale(transforms[i], glm::dvec3(values[i]));
    }
  }
  return transforms;
}

enum class Placement { kGood, kFlat, kNotFinite };

Placement judge(const glm::dmat4& worldFromObject) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) {
      if (!(std::abs(worldFromObject[column][row]) <= kLargestCoordinate)) {
        return Placement::kNotFinite;
      }
    }
  }
  // Judged relative to the lengths of the columns: a matrix of tiny scale is fine, one without an inverse is
  // not.
  const glm::dmat3 linear(worldFromObject);
  const double lengths = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
  return std::abs(glm::determinant(linear)) > 1e-10 * lengths && lengths > 1e-30 ? Placement::kGood
                                                                                 : Placement::kFlat;
}

}  // namespace

std::vector<Instance> placeMeshes(const Gltf& gltf, const std::vector<PlacedNode>& nodes,
                                  const Accessors& accessors, MeshStore& meshes, Budget& budget,
                                  Warnings& warnings) {
  std::vector<Instance> instances;
  SkinStore skins(gltf, nodes, accessors, warnings);
  std::size_t flat = 0;
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Node& node = gltf.model.nodes[static_cast<std::size_t>(placed.node)];
    if (node.mesh < 0) {
      continue;
    }
    const std::string place = at("nodes", static_cast<std::size_t>(placed.node));
    gltf.checkIndex(node.mesh, gltf.model.meshes.size(), place + ".mesh", "mesh");
    const Joints* joints = nullptr;
    if (node.skin >= 0) {
      warnings.add("skinned meshes are shown at rest");
      joints = skins.joints(node.skin, place + ".skin");
    }
    const std::vector<int>& shown = meshes.meshesOf(node, joints);
    if (shown.empty()) {
      continue;
    }
    const std::vector<glm::dmat4> transforms = objectTransforms(gltf, placed.node, accessors, budget);
    budget.chargeInstances(transforms.size() * shown.size());
    const std::string name = printable(node.name);
    budget.chargeGeometry(transforms.size() * shown.size(), sizeof(Instance) + name.size());
    for (const glm::dmat4& nodeFromObject : transforms) {
      // The transform of a skinned mesh's node does not count (glTF 2.0, 3.7.3.3).
      const glm::dmat4 worldFromObject =
          joints != nullptr ? nodeFromObject : placed.worldFromNode * nodeFromObject;
      const Placement placement = judge(worldFromObject);
      if (placement == Placement::kNotFinite) {
        gltf.fail(place, "an instance's transform is not finite or beyond 1e15");
      }
      if (placement == Placement::kFlat) {
        ++flat;
        continue;
      }
      for (const int mesh : shown) {
        instances.push_back({name, mesh, glm::mat4x3(worldFromObject)});
      }
    }
  }
  if (flat > 0) {
    warnings.add(std::to_string(flat) + (flat == 1 ? " instance has" : " instances have") +
                 " a scale of zero and are left out");
  }
  return instances;
}

}  // namespace promenade::scene
