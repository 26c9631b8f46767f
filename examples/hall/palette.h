#pragma once
// The materials of the hall.

#include "examples/hall/gltf_writer.h"

namespace promenade::hall {

struct Palette {
  MaterialId floorTiles, paleMarble, darkMarble, polishedMarble, plaster, windowWall, vaultPlaster, rosette,
      damask, apseBlue, wood;
  MaterialId gold, gilt, bronze, brass, steel, iron, mirror, glass;
  MaterialId porcelain, terracotta, leather, whitePaint;
  MaterialId skylight, laylightLeft, laylightRight, window, lamp;
};

/// Adds the textures and materials to `gltf`.
[[nodiscard]] Palette makePalette(GltfWriter& gltf);

}  // namespace promenade::hall
