#pragma once
// Internal: one mesh primitive to one triangle mesh.

#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/scene/accessors.h"
#include "src/scene/scene.h"

namespace promenade::scene {

/// worldFromBind of each joint of a skin.
using Joints = std::vector<glm::dmat4>;

/// What deforms a primitive at rest.
struct Pose {
  const std::vector<double>& weights;  ///< of the morph targets; empty: all zero
  const Joints* joints = nullptr;      ///< null for a mesh without skin
};

/// Whether the primitive has positions and is not made of points or lines (else a warning is added). Throws
/// InputError for a mode that glTF does not have.
[[nodiscard]] bool hasTriangles(const Gltf& gltf, const tinygltf::Primitive& primitive,
                                const std::string& place, Warnings& warnings);

/// `materials` are the file's, followed by the default material. Nothing (and a warning) if the primitive has
/// no triangles. With joints the mesh is in world space. Throws InputError; `place` names the primitive.
[[nodiscard]] std::optional<Mesh> readPrimitive(const Gltf& gltf, const Accessors& accessors,
                                                const tinygltf::Primitive& primitive,
                                                const std::string& place,
                                                const std::vector<Material>& materials, const Pose& pose,
                                                Budget& budget, Warnings& warnings);

}  // namespace promenade::scene
