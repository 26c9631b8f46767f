#pragma once
// Internal: skinned meshes at rest (glTF 2.0, 3.7.3): vertices are placed in the world by the rest transforms
// of their joints.

#include <glm/mat4x4.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "src/scene/accessors.h"
#include "src/scene/nodes.h"
#include "src/scene/primitives.h"

namespace promenade::scene {

/// The joints of each skin, found once.
class SkinStore {
 public:
  SkinStore(const Gltf& gltf, const std::vector<PlacedNode>& nodes, const Accessors& accessors,
            Warnings& warnings);

  /// worldFromBind of each joint of a skin, all nodes at rest; null (and a warning) if a joint is not in
  /// the shown scene. Throws InputError: no such skin, inverse bind matrices that are too few or not finite.
  [[nodiscard]] const Joints* joints(int skin, const std::string& place);

 private:
  [[nodiscard]] std::optional<Joints> find(int skin) const;

  const Gltf& gltf_;
  const std::vector<PlacedNode>& nodes_;
  const Accessors& accessors_;
  Warnings& warnings_;
  std::vector<int> placedAt_;  ///< of each node of the file: its index in nodes_, or -1
  std::map<int, std::optional<Joints>> found_;
};

/// What binds the vertices of a primitive to joints: for each vertex four (or, with a second set, eight)
/// joints and weights.
struct Binding {
  std::vector<std::vector<glm::vec4>> joints;   ///< a set each, as long as the positions
  std::vector<std::vector<glm::vec4>> weights;  ///< the same
};

/// Moves positions, normals and tangents of `mesh` from bind space to world space. Triangles that this
/// mirrors get their corners swapped, so that their front stays their front. Throws InputError(source,
/// place...): a joint that the skin does not have.
[[nodiscard]] Mesh poseMesh(Mesh mesh, const Binding& binding, const Joints& joints, const Gltf& gltf,
                            const std::string& place);

}  // namespace promenade::scene
