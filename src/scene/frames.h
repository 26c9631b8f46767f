#pragma once
// Internal: normals and tangents of a mesh as Scene promises them, repaired or made where the file has none.

#include <string>

#include "src/scene/gltf.h"
#include "src/scene/scene.h"

namespace promenade::scene {

/// Without normals: flat ones, every triangle with vertices of its own (glTF 2.0, 3.7.2.1). Normals and
/// tangents without a direction are replaced (with a warning). Tangents are made where the material has a
/// normal map and the file has none. Precondition: attributes as long as the positions, triangles in range.
[[nodiscard]] Mesh finishFrames(Mesh mesh, const Material& material, const Gltf& gltf,
                                const std::string& place, Budget& budget, Warnings& warnings);

}  // namespace promenade::scene
