#pragma once
// Internal: the meshes of the scene, each made once.

#include <map>
#include <tuple>
#include <vector>

#include "src/scene/primitives.h"

namespace promenade::scene {

/// Builds each primitive once, when it is first placed.
class MeshStore {
 public:
  /// `materials` are the file's, followed by the default material.
  MeshStore(const Gltf& gltf, const Accessors& accessors, const std::vector<Material>& materials,
            Budget& budget, Warnings& warnings)
      : gltf_(gltf), accessors_(accessors), materials_(materials), budget_(budget), warnings_(warnings) {}

  /// Indices in Scene::meshes of the primitives of the mesh that `node` shows, without those that hold no
  /// triangles. With `joints` (of the node's skin), meshes that are already in world space.
  /// Precondition: the node's mesh and skin indices are good. Throws InputError.
  [[nodiscard]] const std::vector<int>& meshesOf(const tinygltf::Node& node, const Joints* joints);

  [[nodiscard]] std::vector<Mesh> take() { return std::move(meshes_); }

 private:
  // Mesh, skin (-1: none), the node's own morph target weights.
  using Key = std::tuple<int, int, std::vector<double>>;

  /// The primitives of a mesh that may have triangles.
  [[nodiscard]] const std::vector<std::size_t>& drawable(int mesh);
  [[nodiscard]] std::vector<int> build(const tinygltf::Node& node, const Joints* joints);
  [[nodiscard]] static std::string place(int mesh, std::size_t primitive);

  const Gltf& gltf_;
  const Accessors& accessors_;
  const std::vector<Material>& materials_;
  Budget& budget_;
  Warnings& warnings_;
  std::map<Key, std::vector<int>> shown_;
  std::map<int, std::vector<std::size_t>> drawable_;
  std::vector<Mesh> meshes_;
};

}  // namespace promenade::scene
