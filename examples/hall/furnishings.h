#pragma once
// What stands and hangs in the hall.

#include "examples/hall/palette.h"

namespace promenade::hall {

void addPictures(GltfWriter& gltf, const Palette& palette);    ///< framed pictures and the mirror
void addSculptures(GltfWriter& gltf, const Palette& palette);  ///< on plinths, in the nave and the apse
void addGlassCase(GltfWriter& gltf, const Palette& palette);   ///< with what is shown in it
void addFurniture(GltfWriter& gltf, const Palette& palette);   ///< benches, railings, lamps

}  // namespace promenade::hall
