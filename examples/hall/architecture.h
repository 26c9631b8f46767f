#pragma once
// The building: floor, columns, beams, vault, walls, ceilings, and the luminous surfaces that light it.

#include "examples/hall/palette.h"

namespace promenade::hall {

void addFloor(GltfWriter& gltf, const Palette& palette);
void addColonnade(GltfWriter& gltf, const Palette& palette);
void addVault(GltfWriter& gltf, const Palette& palette);
void addAisleCeilings(GltfWriter& gltf, const Palette& palette);
void addWindowWall(GltfWriter& gltf, const Palette& palette);
void addPictureWall(GltfWriter& gltf, const Palette& palette);
void addEndWalls(GltfWriter& gltf, const Palette& palette);

}  // namespace promenade::hall
