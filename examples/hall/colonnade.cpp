// Columns, pilasters and the beams (entablatures) they carry.

#include <algorithm>
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

Surface column() {
  constexpr double kBottom = 0.47, kTop = 3.98, kBottomRadius = 0.40, kTopRadius = 0.335;
  constexpr int kFlutes = 20;
  const auto shaft = parametric(
      [](double u, double v) {
        const double angle = 2.0 * glm::pi<double>() * u;
        const double straight = kBottomRadius + (kTopRadius - kBottomRadius) * v;
        const double entasis = 0.012 * std::sin(glm::pi<double>() * std::clamp(v, 0.0, 1.0));
        // Flutes meet in arrises and run out before the ends of the shaft.
        const double running = smoothStep(0.0, 0.03, v) * smoothStep(1.0, 0.97, v);
        const double flute = 0.040 * running * std::abs(std::sin(0.5 * kFlutes * angle));
        const double radius = straight + entasis - flute;
        return dvec3(radius * std::sin(angle), kBottom + (kTop - kBottom) * v, radius * std::cos(angle));
      },
      kFlutes * 7, 24, {3.0 * kMarbleMetres / kMarbleMetres, kTop - kBottom});
  Surface s;
  s.add(box({-0.53, 0.0, -0.53}, {0.53, 0.16, 0.53}, 0.008));
  s.add(lathe(Profile({0.45, 0.16})
                  .quarterTo({0.52, 0.225}, Bulge::kOutward)
                  .quarterTo({0.455, 0.29}, Bulge::kOutward)
                  .lineTo({0.455, 0.305})
                  .quarterTo({0.43, 0.365}, Bulge::kInward)
                  .lineTo({0.44, 0.37})
                  .quarterTo({0.465, 0.395}, Bulge::kOutward)
                  .quarterTo({0.44, 0.42}, Bulge::kOutward)
                  .lineTo({0.425, 0.425})
                  .quarterTo({kBottomRadius, kBottom}, Bulge::kInward),
              64)
            .scaleTexture({3.0, 1.0}));
  s.add(shaft);
  s.add(lathe(Profile({kTopRadius, kTop})
                  .quarterTo({0.365, 4.0}, Bulge::kOutward, 4)
                  .quarterTo({0.335, 4.025}, Bulge::kOutward, 4)
                  .lineTo({0.335, 4.19})
                  .lineTo({0.36, 4.195})
                  .lineTo({0.36, 4.215})
                  .lineTo({0.375, 4.22})
                  .quarterTo({0.50, 4.40}, Bulge::kOutward, 8)
                  .lineTo({0.48, 4.42}),
              64)
            .scaleTexture({3.0, 1.0}));
  s.add(box({-0.52, 4.42, -0.52}, {0.52, 4.58, 0.52}, 0.008));
  s.add(box({-0.56, 4.58, -0.56}, {0.56, kColumnTop, 0.56}, 0.02));
  return s;
}

/// Against a wall that faces +Z.
Surface pilaster() {
  Surface s;
  s.add(box({-0.36, 0.0, -0.02}, {0.36, 0.30, 0.17}, 0.008));
  s.add(box({-0.30, 0.30, -0.02}, {0.30, 4.55, 0.12}, 0.008));
  s.add(box({-0.33, 4.55, -0.02}, {0.33, 4.62, 0.15}, 0.012));
  s.add(box({-0.31, 4.62, -0.02}, {0.31, 4.76, 0.13}, 0.006));
  s.add(box({-0.38, 4.76, -0.02}, {0.38, 5.0, 0.20}, 0.02));
  return s;
}

/// One beam over a row of columns, about x = 0; its nave side faces +X.
Surface beam() {
  const Profile nave = Profile({0.34, kColumnTop})
                           .lineTo({0.34, 4.83})
                           .lineTo({0.36, 4.835})
                           .lineTo({0.36, 4.97})
                           .quarterTo({0.41, 5.03}, Bulge::kOutward)
                           .lineTo({0.41, 5.05})
                           .lineTo({0.36, 5.05})
                           .lineTo({0.36, 5.32})
                           .quarterTo({0.40, 5.36}, Bulge::kInward)
                           .lineTo({0.40, 5.47})
                           .lineTo({0.54, 5.48})
                           .lineTo({0.54, 5.57})
                           .quarterTo({0.58, 5.62}, Bulge::kOutward)
                           .quarterTo({0.61, 5.68}, Bulge::kInward)
                           .lineTo({0.61, kSpringing})
                           .lineTo({kBeamHalf, kSpringing});
  const Profile aisle = Profile({0.34, kColumnTop})
                            .lineTo({0.34, 4.83})
                            .lineTo({0.36, 4.835})
                            .lineTo({0.36, 4.97})
                            .quarterTo({kBeamHalf, 5.03}, Bulge::kOutward)
                            .lineTo({kBeamHalf, kAisleCeiling});
  Surface s;
  s.add(extrude(nave, -kHalfLength, kHalfLength));
  s.add(extrude(aisle, -kHalfLength, kHalfLength), turned(glm::pi<double>(), {0, 1, 0}));
  s.addQuad({-0.34, kColumnTop, -kHalfLength}, {0.34, kColumnTop, -kHalfLength},
            {0.34, kColumnTop, kHalfLength}, {-0.34, kColumnTop, kHalfLength});
  return s;
}

/// The row of small blocks under the cornice, one bay of it, facing +X.
Surface dentils() {
  Surface s;
  constexpr int kCount = 24;
  for (int i = 0; i < kCount; ++i) {
    const double z = kBay * ((i + 0.5) / kCount - 0.5);
    s.add(box({0.39, 5.38, z - 0.045}, {0.48, 5.475, z + 0.045}));
  }
  return s;
}

}  // namespace

void addColonnade(GltfWriter& gltf, const Palette& palette) {
  const dvec2 marble(1.0 / kMarbleMetres);
  const MeshId columnMesh = gltf.addMesh("column", column(), palette.paleMarble, marble);
  const MeshId pilasterMesh = gltf.addMesh("pilaster", pilaster(), palette.paleMarble, marble);
  const MeshId beamMesh = gltf.addMesh("beam", beam(), palette.vaultPlaster);
  const MeshId dentilMesh = gltf.addMesh("dentils", dentils(), palette.vaultPlaster);
  for (const double side : {-1.0, 1.0}) {
    const std::string_view name = side < 0.0 ? "left" : "right";
    const double facingNave = side < 0.0 ? 0.0 : 180.0;
    for (std::size_t i = 0; i < kColumnZ.size(); ++i) {
      // No two neighbours show the same veins.
      gltf.addNode(named("column", name, i + 1), columnMesh,
                   {.translation = {side * kColumnX, 0.0, kColumnZ[i]},
                    .yawDegrees = 90.0 * static_cast<double>(i % 4)});
      gltf.addNode(named("pilaster", name, i + 1), pilasterMesh,
                   {.translation = {side * kWallX, 0.0, kColumnZ[i]}, .yawDegrees = -side * 90.0});
      gltf.addNode(named("dentils", name, i + 1), dentilMesh,
                   {.translation = {side * kColumnX, 0.0, kColumnZ[i]}, .yawDegrees = facingNave});
    }
    gltf.addNode(named("beam", name), beamMesh,
                 {.translation = {side * kColumnX, 0.0, 0.0}, .yawDegrees = facingNave});
  }
}

}  // namespace promenade::hall
