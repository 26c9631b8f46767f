#include "src/scene/meshes.h"

#include <algorithm>

namespace promenade::scene {

const std::vector<int>& MeshStore::meshesOf(const tinygltf::Node& node, const Joints* joints) {
  const auto [found, isNew] =
      shown_.try_emplace(Key(node.mesh, joints != nullptr ? node.skin : -1, node.weights));
  if (isNew) {
    found->second = build(node, joints);
  }
  return found->second;
}

const std::vector<std::size_t>& MeshStore::drawable(int mesh) {
  const auto [found, isNew] = drawable_.try_emplace(mesh);
  if (isNew) {
    const auto& primitives = gltf_.model.meshes[static_cast<std::size_t>(mesh)].primitives;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      if (hasTriangles(gltf_, primitives[i], place(mesh, i), warnings_)) {
        found->second.push_back(i);
      }
    }
  }
  return found->second;
}

std::vector<int> MeshStore::build(const tinygltf::Node& node, const Joints* joints) {
  const tinygltf::Mesh& source = gltf_.model.meshes[static_cast<std::size_t>(node.mesh)];
  std::vector<double> weights = node.weights.empty() ? source.weights : node.weights;
  if (std::all_of(weights.begin(), weights.end(), [](double weight) { return weight == 0.0; })) {
    weights.clear();
  }
  std::vector<int> result;
  for (const std::size_t i : drawable(node.mesh)) {
    const tinygltf::Primitive& primitive = source.primitives[i];
    if (!primitive.targets.empty()) {
      warnings_.add("morph targets are shown at rest");
    }
    budget_.chargeGeometry(1, sizeof(Mesh));
    if (std::optional<Mesh> mesh = readPrimitive(gltf_, accessors_, primitive, place(node.mesh, i),
                                                 materials_, {weights, joints}, budget_, warnings_)) {
      mesh->name = printable(source.name);
      result.push_back(static_cast<int>(meshes_.size()));
      meshes_.push_back(std::move(*mesh));
    }
  }
  return result;
}

std::string MeshStore::place(int mesh, std::size_t primitive) {
  return at("meshes", static_cast<std::size_t>(mesh)) + ".primitives[" + std::to_string(primitive) + "]";
}

}  // namespace promenade::scene
