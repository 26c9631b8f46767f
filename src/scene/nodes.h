#pragma once
// Internal: the node hierarchy of the scene that is shown, flattened.

#include <glm/mat4x4.hpp>
#include <vector>

#include "src/scene/gltf.h"

namespace promenade::scene {

/// A node of the shown scene. Parents come before their children.
struct PlacedNode {
  int node = 0;     ///< index into the file's nodes
  int parent = -1;  ///< index into the list of placed nodes; -1 for a root
  int depth = 1;
  glm::dmat4 worldFromNode{1.0};
};

/// The node's own transform at rest. Throws InputError: a wrong number of elements, not affine.
[[nodiscard]] glm::dmat4 restTransform(const Gltf& gltf, std::size_t node);

/// Checks the hierarchy of the whole file (indices, one parent each, no cycles) and places the nodes of the
/// shown scene: the default one, else the first, else every root. Throws InputError.
[[nodiscard]] std::vector<PlacedNode> placeNodes(const Gltf& gltf);

}  // namespace promenade::scene
