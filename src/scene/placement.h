#pragma once
// Internal: what the nodes of the shown scene carry: instances of meshes, punctual lights, cameras with their
// animations.

#include <vector>

#include "src/scene/meshes.h"
#include "src/scene/nodes.h"
#include "src/scene/scene.h"

namespace promenade::scene {

/// Instances of the meshes of all placed nodes, EXT_mesh_gpu_instancing expanded. Instances without volume to
/// be seen in (a scale of zero) are left out with a warning.
[[nodiscard]] std::vector<Instance> placeMeshes(const Gltf& gltf, const std::vector<PlacedNode>& nodes,
                                                const Accessors& accessors, MeshStore& meshes, Budget& budget,
                                                Warnings& warnings);

/// KHR_lights_punctual.
[[nodiscard]] std::vector<PunctualLight> placeLights(const Gltf& gltf, const std::vector<PlacedNode>& nodes,
                                                     Warnings& warnings);

/// Each perspective camera at rest, then each of them under each animation that moves it or a node above it.
[[nodiscard]] std::vector<CameraAnimation> placeCameras(const Gltf& gltf,
                                                        const std::vector<PlacedNode>& nodes,
                                                        const Accessors& accessors, Budget& budget,
                                                        Warnings& warnings);

}  // namespace promenade::scene
