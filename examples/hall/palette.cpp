#include "examples/hall/palette.h"

#include "examples/hall/textures.h"

namespace promenade::hall {
namespace {

// Radiances of the luminous surfaces. They are few, large and unobstructed, so that light is found by
// sampling them; a white wall comes out at a radiance of about 0.6.
const Color kSky = Color(0.93, 0.97, 1.0);
const Color kLampLight = Color(1.0, 0.80, 0.55);
constexpr double kSkylightRadiance = 7.0;
constexpr double kLeftLaylightRadiance = 4.0;    // the windows are there too
constexpr double kRightLaylightRadiance = 10.0;  // the pictures get nearly all their light from here
constexpr double kWindowRadiance = 5.0;
constexpr double kLampRadiance = 3.0;

}  // namespace

Palette makePalette(GltfWriter& gltf) {
  const ImageId tiles = gltf.addImage("stone-tiles", stoneTiles());
  const ImageId tilesNormals = gltf.addImage("stone-tiles-normals", stoneTilesNormals());
  const ImageId pale = gltf.addImage("pale-marble", paleMarble());
  const ImageId dark = gltf.addImage("dark-marble", darkMarble());
  const ImageId plasterImage = gltf.addImage("plaster", plaster());
  const ImageId plasterBumps = gltf.addImage("plaster-normals", plasterNormals());
  const ImageId damaskImage = gltf.addImage("damask", damask());
  const ImageId woodImage = gltf.addImage("wood", wood());
  const ImageId porcelainImage = gltf.addImage("porcelain", glazedPorcelain());

  const auto rough = [&](const char* name, const Color& color, double roughness) {
    return gltf.addMaterial({.name = name, .baseColor = color, .roughness = roughness});
  };
  const auto metal = [&](const char* name, const Color& color, double roughness) {
    return gltf.addMaterial({.name = name, .baseColor = color, .metallic = 1.0, .roughness = roughness});
  };
  const auto luminous = [&](const char* name, const Color& color, double radiance) {
    return gltf.addMaterial(
        {.name = name, .baseColor = Color(0.8), .roughness = 1.0, .emission = radiance * color});
  };

  Palette p{};
  p.floorTiles = gltf.addMaterial(
      {.name = "floor-tiles", .baseColorImage = tiles, .roughness = 0.7, .normalImage = tilesNormals});
  p.paleMarble = gltf.addMaterial({.name = "pale-marble", .baseColorImage = pale, .roughness = 0.65});
  p.darkMarble = gltf.addMaterial({.name = "dark-marble", .baseColorImage = dark, .roughness = 0.6});
  p.polishedMarble = gltf.addMaterial({.name = "polished-marble", .baseColorImage = dark, .roughness = 0.08});
  p.plaster = gltf.addMaterial({.name = "plaster",
                                .baseColor = Color(0.92, 0.90, 0.86),
                                .baseColorImage = plasterImage,
                                .roughness = 0.9,
                                .normalImage = plasterBumps});
  p.windowWall = gltf.addMaterial({.name = "window-wall-plaster",
                                   .baseColor = {0.74, 0.80, 0.78},
                                   .baseColorImage = plasterImage,
                                   .roughness = 0.9,
                                   .normalImage = plasterBumps});
  p.vaultPlaster = rough("vault-plaster", {0.62, 0.58, 0.51}, 0.9);
  p.rosette = rough("rosette", {0.62, 0.43, 0.16}, 0.7);
  p.damask = gltf.addMaterial({.name = "damask", .baseColorImage = damaskImage, .roughness = 0.95});
  p.apseBlue = rough("apse-blue", {0.13, 0.25, 0.44}, 0.85);
  p.wood = gltf.addMaterial({.name = "wood", .baseColorImage = woodImage, .roughness = 0.6});
  p.gold = metal("gold", {1.0, 0.72, 0.32}, 0.22);
  p.gilt = metal("gilt", {0.86, 0.62, 0.28}, 0.5);
  p.bronze = metal("bronze", {0.50, 0.33, 0.19}, 0.42);
  p.brass = metal("brass", {0.88, 0.68, 0.36}, 0.35);
  p.steel = metal("steel", {0.72, 0.74, 0.76}, 0.18);
  p.iron = rough("wrought-iron", {0.035, 0.035, 0.04}, 0.6);
  p.mirror = metal("mirror", {0.93, 0.94, 0.94}, 0.0);
  p.glass = gltf.addMaterial({.name = "glass",
                              .baseColor = Color(0.97, 0.99, 0.98),
                              .roughness = 0.0,
                              .transmission = 1.0,
                              .doubleSided = true});
  p.porcelain = gltf.addMaterial({.name = "porcelain", .baseColorImage = porcelainImage, .roughness = 0.15});
  p.terracotta = rough("terracotta", {0.52, 0.22, 0.11}, 0.75);
  p.leather = rough("leather", {0.13, 0.06, 0.035}, 0.6);
  p.whitePaint = rough("white-paint", {0.62, 0.60, 0.56}, 0.7);
  p.skylight = luminous("skylight", kSky, kSkylightRadiance);
  const Color aisleLight = mix(kSky, Color(1.0, 0.95, 0.85), 0.6);
  p.laylightLeft = luminous("laylight-left", aisleLight, kLeftLaylightRadiance);
  p.laylightRight = luminous("laylight-right", aisleLight, kRightLaylightRadiance);
  p.window = luminous("window", kSky, kWindowRadiance);
  p.lamp = luminous("lamp", kLampLight, kLampRadiance);
  return p;
}

}  // namespace promenade::hall
