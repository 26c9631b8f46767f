#include "src/scene/meshes.h"

#include <algorithm>

namespace promenade::scene {

std::vector<int> MeshStore::meshesOf(const tinygltf::Node& node, const Joints& joints) {
  const auto meshIndex = static_cast<std::size_t>(node.mesh);
  const tinygltf::Mesh& source = gltf_.model.meshes[meshIndex];
  std::vector<double> weights = node.weights.empty() ? source.weights : node.weights;
  if (std::all_of(weights.begin(), weights.end(), [](double weight) { return weight == 0.0; })) {
    weights.clear();
  }
  std::vector<int> result;
  for (std::size_t i = 0; i < source.primitives.size(); ++i) {
    const auto [found, isNew] = built_.try_emplace(Key(node.mesh, i, joints ? node.skin : -1, weights), -1);
    if (isNew) {
      const std::string place = at("meshes", meshIndex) + ".primitives[" + std::to_string(i) + "]";
      if (!source.primitives[i].targets.empty()) {
        warnings_.add("morph targets are shown at rest");
      }
      if (std::optional<Mesh> mesh = readPrimitive(gltf_, accessors_, source.primitives[i], place, materials_,
                                                   {weights, joints}, budget_, warnings_)) {
        mesh->name = printable(source.name);
        found->second = static_cast<int>(meshes_.size());
        meshes_.push_back(std::move(*mesh));
      }
    }
    if (found->second >= 0) {
      result.push_back(found->second);
    }
  }
  return result;
}

}  // namespace promenade::scene
