#include "examples/hall/hall.h"

#include <glm/trigonometric.hpp>

#include "examples/hall/architecture.h"
#include "examples/hall/furnishings.h"
#include "examples/hall/walk.h"

namespace promenade::hall {

HallStatistics writeHall(const std::filesystem::path& folder) {
  GltfWriter gltf;
  const Palette palette = makePalette(gltf);
  addFloor(gltf, palette);
  addColonnade(gltf, palette);
  addVault(gltf, palette);
  addAisleCeilings(gltf, palette);
  addWindowWall(gltf, palette);
  addPictureWall(gltf, palette);
  addEndWalls(gltf, palette);
  addPictures(gltf, palette);
  addSculptures(gltf, palette);
  addGlassCase(gltf, palette);
  addFurniture(gltf, palette);
  gltf.addWalk("walk", glm::radians(kWalkFieldOfViewDegrees), walkKeys());
  const std::size_t bytes = gltf.write(folder, "hall");
  return {gltf.triangleCount(), bytes};
}

}  // namespace promenade::hall
