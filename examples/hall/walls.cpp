// Floor and walls.

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "examples/hall/architecture.h"
#include "examples/hall/layout.h"
#include "examples/hall/names.h"
#include "examples/hall/textures.h"

namespace promenade::hall {
namespace {

using glm::dvec2;
using glm::dvec3;
using Bulge = Profile::Bulge;

constexpr double kDadoHeight = 1.0;
constexpr double kCorniceBottom = 5.0;
const ArchOpening kWindow{.sill = 1.0, .springing = 3.35, .halfWidth = 1.05};
constexpr double kWindowDepth = 0.40;
constexpr double kBorder = 0.15;  // of the polished band
constexpr double kBandEnd = 9.6;

/// A horizontal rectangle facing up, with texture coordinates (x, z).
Surface floorPiece(double x0, double z0, double x1, double z1) {
  Surface s;
  s.addQuad({x0, 0, z1}, {x1, 0, z1}, {x1, 0, z0}, {x0, 0, z0});
  for (std::size_t i = 0; i < s.positions.size(); ++i) s.texCoords[i] = {s.positions[i].x, s.positions[i].z};
  return s;
}

/// A plane wall in z = 0 that faces +Z.
Surface plainWall(double width, double bottom, double top) {
  const double half = 0.5 * width;
  return Surface().addQuad({-half, bottom, 0}, {half, bottom, 0}, {half, top, 0}, {-half, top, 0});
}

/// The panelling of one bay, facing +Z, its texture's grain upright.
Surface dado() {
  Surface s = plainWall(kBay, 0.0, kDadoHeight);
  s.add(box({-0.5 * kBay, 0.0, 0.0}, {0.5 * kBay, 0.16, 0.035}));
  s.add(box({-0.5 * kBay, kDadoHeight - 0.05, 0.0}, {0.5 * kBay, kDadoHeight, 0.06}, 0.01));
  constexpr int kPanels = 3;
  for (int i = 0; i < kPanels; ++i) {
    const double x = kBay * ((i + 0.5) / kPanels - 0.5);
    s.add(frame(0.86, 0.50, {{-0.03, 0.002}, {-0.02, 0.02}, {0.0, 0.03}, {0.03, 0.02}, {0.05, 0.0}}),
          moved({x, 0.56, 0.0}));
  }
  return s;
}

/// Mullions of a window, seen from +Z, about 5 cm deep.
Surface mullions() {
  Surface s;
  const double w = kWindow.halfWidth;
  for (const double x : {-w / 3.0, w / 3.0}) {
    s.add(box({x - 0.018, kWindow.sill, 0.0}, {x + 0.018, kWindow.springing, 0.05}));
  }
  for (int k = 0; k <= 4; ++k) {
    const double y = kWindow.sill + (kWindow.springing - kWindow.sill) * k / 4.0;
    const double half = k == 0 || k == 4 ? 0.03 : 0.015;
    s.add(box({-w, y - half, 0.0}, {w, y + half, 0.045}));
  }
  for (int k = 1; k < 6; ++k) {  // the rays of the fanlight
    const double angle = glm::pi<double>() * k / 6.0;
    s.add(rod({0.3 * w * std::cos(angle), kWindow.springing + 0.3 * w * std::sin(angle), 0.02},
              {w * std::cos(angle), kWindow.springing + w * std::sin(angle), 0.02}, 0.016, 6));
  }
  const auto ring = [](double radius) {
    return [radius](double u) {
      return dvec3(radius * std::cos(glm::pi<double>() * u),
                   kWindow.springing + radius * std::sin(glm::pi<double>() * u), 0.02);
    };
  };
  s.add(tube(
      ring(0.3 * w), [](double) { return 0.018; }, 16, 6, Ends::kOpen));
  s.add(tube(
      ring(w - 0.01), [](double) { return 0.03; }, 24, 6, Ends::kOpen));
  return s;
}

/// The cornice under the ceiling of an aisle, on a wall x = 0 that faces +X.
Surface cornice() {
  return extrude(Profile({0.0, kCorniceBottom})
                     .lineTo({0.03, kCorniceBottom})
                     .lineTo({0.03, 5.04})
                     .quarterTo({0.10, 5.13}, Bulge::kInward)
                     .lineTo({0.12, 5.14})
                     .lineTo({0.12, kAisleCeiling}),
                 -kHalfLength, kHalfLength);
}

/// The moulding under the vault, on an end wall in z = 0 that faces +Z.
Surface endCornice() {
  const Surface s = extrude(Profile({0.0, 5.46})
                                .lineTo({0.03, 5.46})
                                .quarterTo({0.10, 5.54}, Bulge::kInward)
                                .lineTo({0.12, 5.55})
                                .lineTo({0.12, 5.62})
                                .quarterTo({0.17, 5.68}, Bulge::kInward)
                                .lineTo({0.17, kSpringing})
                                .lineTo({0.0, kSpringing}),
                            -kVaultRadius, kVaultRadius);
  return Surface().add(s, turned(-0.5 * glm::pi<double>(), {0, 1, 0}));
}

/// Around the mouth of the apse, on the same wall: two rolls over the arch, a band down each side, and a
/// keystone.
Surface archivolt() {
  const auto arch = [](double radius) {
    return [radius](double u) {
      return dvec3(-radius * std::cos(glm::pi<double>() * u),
                   kApseSpringing + radius * std::sin(glm::pi<double>() * u), 0.02);
    };
  };
  Surface s = tube(
      arch(kApseRadius + 0.05), [](double) { return 0.05; }, 48, 10, Ends::kOpen);
  s.add(tube(
      arch(kApseRadius + 0.22), [](double) { return 0.07; }, 48, 10, Ends::kOpen));
  for (const double side : {-1.0, 1.0}) {
    const double x = side * (kApseRadius + 0.15);
    s.add(box({x - 0.15, 0.0, 0.0}, {x + 0.15, kApseSpringing - 0.12, 0.07}, 0.01));
    s.add(box({x - 0.19, kApseSpringing - 0.12, 0.0}, {x + 0.19, kApseSpringing, 0.11}, 0.015));
  }
  return s.add(box({-0.14, kApseSpringing + kApseRadius - 0.04, 0.0},
                   {0.14, kApseSpringing + kApseRadius + 0.36, 0.14}, 0.02));
}

Surface apseWall() {
  return parametric(
      [](double u, double v) {
        const double angle = glm::pi<double>() * (u - 0.5);
        return dvec3(kApseRadius * std::sin(angle), kApseSpringing * v, -kApseRadius * std::cos(angle));
      },
      48, 1, {glm::pi<double>() * kApseRadius, -kApseSpringing});
}

Surface apseDome() {
  return parametric(
      [](double u, double v) {
        const double longitude = glm::pi<double>() * (u - 0.5), latitude = 0.5 * glm::pi<double>() * v;
        // A shell: shallow flutes that vanish at the rim and at the top.
        const double fluting = 1.0 - 0.035 * std::abs(std::sin(9.0 * longitude)) * smoothStep(0.02, 0.2, v) *
                                         smoothStep(1.0, 0.8, v);
        const double r = kApseRadius * fluting;
        return dvec3(r * std::cos(latitude) * std::sin(longitude), kApseSpringing + r * std::sin(latitude),
                     -r * std::cos(latitude) * std::cos(longitude));
      },
      108, 24, {1.0, 1.0});
}

}  // namespace

void addFloor(GltfWriter& gltf, const Palette& palette) {
  const dvec2 tiles(1.0 / kTilesMetres), marble(1.0 / kMarbleMetres);
  const double inner = kBandHalf + kBorder, end = kBandEnd + kBorder;
  const double apseBack = -kHalfLength - kApseReveal - kApseRadius;
  const auto add = [&](const char* name, const Surface& surface, MaterialId material, dvec2 scale) {
    gltf.addNode(name, gltf.addMesh(name, surface, material, scale));
  };
  add("floor-left", floorPiece(-kWallX, -kHalfLength, -inner, kHalfLength), palette.floorTiles, tiles);
  add("floor-right", floorPiece(inner, -kHalfLength, kWallX, kHalfLength), palette.floorTiles, tiles);
  add("floor-near", floorPiece(-inner, end, inner, kHalfLength), palette.floorTiles, tiles);
  add("floor-far", floorPiece(-inner, -kHalfLength, inner, -end), palette.floorTiles, tiles);
  add("floor-apse", floorPiece(-kApseRadius, apseBack, kApseRadius, -kHalfLength), palette.floorTiles, tiles);
  add("floor-polished", floorPiece(-kBandHalf, -kBandEnd, kBandHalf, kBandEnd), palette.polishedMarble,
      marble);
  Surface border = floorPiece(-inner, -end, -kBandHalf, end);
  border.add(floorPiece(kBandHalf, -end, inner, end));
  border.add(floorPiece(-kBandHalf, -end, kBandHalf, -kBandEnd));
  border.add(floorPiece(-kBandHalf, kBandEnd, kBandHalf, end));
  add("floor-border", border, palette.paleMarble, marble);
}

void addWindowWall(GltfWriter& gltf, const Palette& palette) {
  const dvec2 plasterScale(1.0 / kPlasterMetres);
  const MeshId wall =
      gltf.addMesh("window-bay", wallWithArch(kBay, 0.0, kAisleCeiling, kWindow, kWindowDepth),
                   palette.windowWall, plasterScale);
  const MeshId pane = gltf.addMesh("window", archPane(kWindow), palette.window);
  const MeshId bars = gltf.addMesh("mullions", mullions(), palette.iron);
  const MeshId sill = gltf.addMesh(
      "window-sill", box({-1.2, kWindow.sill - 0.05, -kWindowDepth}, {1.2, kWindow.sill + 0.01, 0.10}, 0.008),
      palette.paleMarble, dvec2(1.0 / kMarbleMetres));
  for (std::size_t i = 0; i < kBayZ.size(); ++i) {
    const Placement at{.translation = {-kWallX, 0.0, kBayZ[i]}, .yawDegrees = 90.0};
    const auto behind = [&](double depth) {
      return Placement{.translation = {-kWallX - depth, 0.0, kBayZ[i]}, .yawDegrees = 90.0};
    };
    gltf.addNode(named("window-bay", i + 1), wall, at);
    gltf.addNode(named("window", i + 1), pane, behind(kWindowDepth));
    gltf.addNode(named("mullions", i + 1), bars, behind(kWindowDepth - 0.01));
    gltf.addNode(named("window-sill", i + 1), sill, at);
  }
  const MeshId end = gltf.addMesh("window-wall-end", plainWall(0.5 * kBay, 0.0, kAisleCeiling),
                                  palette.windowWall, plasterScale);
  for (const double z : {-9.9, 9.9}) {
    gltf.addNode(z < 0.0 ? "window-wall-far" : "window-wall-near", end,
                 {.translation = {-kWallX, 0.0, z}, .yawDegrees = 90.0});
  }
  gltf.addNode("cornice-left", gltf.addMesh("cornice", cornice(), palette.whitePaint),
               {.translation = {-kWallX, 0.0, 0.0}});
}

void addPictureWall(GltfWriter& gltf, const Palette& palette) {
  const MeshId wall = gltf.addMesh("picture-wall", plainWall(2.0 * kHalfLength, kDadoHeight, kCorniceBottom),
                                   palette.damask, dvec2(1.0 / kFabricMetres));
  gltf.addNode("picture-wall", wall, {.translation = {kWallX, 0.0, 0.0}, .yawDegrees = -90.0});
  const MeshId panelling = gltf.addMesh("dado", dado(), palette.wood, dvec2(1.0 / kWoodMetres));
  for (std::size_t i = 0; i < 6; ++i) {
    gltf.addNode(named("dado", i + 1), panelling,
                 {.translation = {kWallX, 0.0, kColumnZ[i]}, .yawDegrees = -90.0});
  }
  gltf.addNode("cornice-right", gltf.addMesh("cornice-right", cornice(), palette.whitePaint),
               {.translation = {kWallX, 0.0, 0.0}, .yawDegrees = 180.0});
}

void addEndWalls(GltfWriter& gltf, const Palette& palette) {
  const dvec2 plasterScale(1.0 / kPlasterMetres);
  constexpr double kCrown = 9.4;  // just above the vault
  const ArchOpening arch{.sill = 0.0, .springing = kApseSpringing, .halfWidth = kApseRadius};
  const double aisleWidth = kWallX - kVaultRadius, aisleMiddle = 0.5 * (kWallX + kVaultRadius);
  const MeshId nave =
      gltf.addMesh("end-wall", wallWithArch(2.0 * kVaultRadius, 0.0, kCrown, arch, kApseReveal),
                   palette.plaster, plasterScale);
  const MeshId aisle = gltf.addMesh("aisle-end-wall", plainWall(aisleWidth, 0.0, kAisleCeiling),
                                    palette.plaster, plasterScale);
  const MeshId corniceMesh = gltf.addMesh("end-cornice", endCornice(), palette.whitePaint);
  const MeshId archivoltMesh =
      gltf.addMesh("archivolt", archivolt(), palette.paleMarble, dvec2(1.0 / kMarbleMetres));
  for (const double end : {-1.0, 1.0}) {
    const std::string_view name = end < 0.0 ? "far" : "near";
    const double z = end * kHalfLength, yaw = end < 0.0 ? 0.0 : 180.0;
    gltf.addNode(named("end-cornice", name), corniceMesh, {.translation = {0.0, 0.0, z}, .yawDegrees = yaw});
    gltf.addNode(named("archivolt", name), archivoltMesh, {.translation = {0.0, 0.0, z}, .yawDegrees = yaw});
    gltf.addNode(named("end-wall", name), nave, {.translation = {0.0, 0.0, z}, .yawDegrees = yaw});
    for (const double side : {-1.0, 1.0}) {
      gltf.addNode(named("aisle-end-wall", name, side < 0.0 ? "left" : "right"), aisle,
                   {.translation = {side * aisleMiddle, 0.0, z}, .yawDegrees = yaw});
    }
  }
  const Placement apse{.translation = {0.0, 0.0, -kHalfLength - kApseReveal}};
  gltf.addNode("apse-wall", gltf.addMesh("apse-wall", apseWall(), palette.plaster, plasterScale), apse);
  gltf.addNode("apse-dome", gltf.addMesh("apse-dome", apseDome(), palette.apseBlue), apse);

  // The way in: a double door under a blind arch.
  const Placement door{.translation = {0.0, 0.0, kHalfLength + kApseReveal}, .yawDegrees = 180.0};
  Surface leaves = box({-kApseRadius, 0.0, -0.1}, {-0.01, kApseSpringing, 0.0}, 0.01);
  leaves.add(box({0.01, 0.0, -0.1}, {kApseRadius, kApseSpringing, 0.0}, 0.01));
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {0.75, 2.2}) {
      leaves.add(frame(1.3, y < 1.0 ? 0.8 : 1.5, {{-0.05, 0.0}, {-0.03, 0.03}, {0.02, 0.04}, {0.05, 0.0}}),
                 moved({x, y, 0.0}));
    }
  }
  gltf.addNode("door", gltf.addMesh("door", leaves, palette.wood, dvec2(1.0 / kWoodMetres)), door);
  gltf.addNode("blind-arch",
               gltf.addMesh("blind-arch", plainWall(2.0 * kApseRadius, kApseSpringing, 5.4), palette.plaster,
                            plasterScale),
               door);
}

}  // namespace promenade::hall
