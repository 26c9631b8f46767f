#pragma once
// Internal: materials with their textures and extensions.

#include <vector>

#include "src/scene/images.h"
#include "src/scene/scene.h"

namespace promenade::scene {

/// All materials of the file, in its order, then the default material of glTF (3.9.1). Values outside their
/// ranges are limited, with a warning. Throws InputError: bad indices, wrong numbers of elements.
[[nodiscard]] std::vector<Material> readMaterials(const Gltf& gltf, ImageStore& images, Warnings& warnings);

}  // namespace promenade::scene
