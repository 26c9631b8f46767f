// The coffered vault with its skylight, and the ceilings of the aisles.

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "examples/hall/architecture.h"
#include "examples/hall/layout.h"
#include "examples/hall/names.h"

namespace promenade::hall {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kCofferDegrees = 20.0;
constexpr double kCofferLength = 0.9;
constexpr double kSkylightHalf = 1.8;  // the three middle coffers of nine: sin(30 degrees) of the radius
constexpr double kSkylightHeight = kSpringing + 3.1177;  // cos(30 degrees) of the radius
constexpr double kSkylightEnd = 9.0;

/// A nested rectangle of a coffer: half sizes along the arc and along Z, and how far it lies behind the
/// vault's surface.
struct Level {
  double halfArc;
  double halfLength;
  double depth;
};

/// A stepped recess in the crown of a vault about the Z axis, seen from the axis.
Surface coffer() {
  const double halfArc = 0.5 * glm::radians(kCofferDegrees) * kVaultRadius, halfLength = 0.5 * kCofferLength;
  const auto level = [&](double inset, double depth) {
    return Level{halfArc - inset, halfLength - inset, depth};
  };
  const std::vector<Level> levels{level(0.0, 0.0),    level(0.085, 0.0),  level(0.095, 0.07),
                                  level(0.155, 0.07), level(0.165, 0.13), level(0.205, 0.13),
                                  level(0.215, 0.17)};
  const auto point = [](double arc, double z, double depth) {
    const double angle = arc / kVaultRadius, radius = kVaultRadius + depth;
    return dvec3(radius * std::sin(angle), radius * std::cos(angle), z);
  };
  Surface s;
  constexpr int kSegments = 5;
  for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
    const Level& outer = levels[k];
    const Level& inner = levels[k + 1];
    for (int side = 0; side < 4; ++side) {
      // Counter-clockwise seen from below, where +X is right and +Z is up.
      const auto at = [&](const Level& l, double t) {
        const double along = 2.0 * t - 1.0;
        const dvec2 p = side == 0   ? dvec2(along, -1.0)
                        : side == 1 ? dvec2(1.0, along)
                        : side == 2 ? dvec2(-along, 1.0)
                                    : dvec2(-1.0, -along);
        return point(p.x * l.halfArc, p.y * l.halfLength, l.depth);
      };
      const int segments = side % 2 == 0 ? kSegments : 1;
      for (int i = 0; i < segments; ++i) {
        const double t0 = static_cast<double>(i) / segments, t1 = static_cast<double>(i + 1) / segments;
        s.addQuad(at(outer, t0), at(outer, t1), at(inner, t1), at(inner, t0));
      }
    }
  }
  const Level& back = levels.back();
  for (int i = 0; i < kSegments; ++i) {
    const double a0 = back.halfArc * (2.0 * i / kSegments - 1.0),
                 a1 = back.halfArc * (2.0 * (i + 1) / kSegments - 1.0);
    s.addQuad(point(a0, -back.halfLength, back.depth), point(a1, -back.halfLength, back.depth),
              point(a1, back.halfLength, back.depth), point(a0, back.halfLength, back.depth));
  }
  return s;
}

/// A flower on the back of a coffer, looking down at the axis.
Surface rosette() {
  const auto petals = [](double radius, double height, double count, double top) {
    return parametric(
        [=](double u, double v) {
          const double angle = 2.0 * glm::pi<double>() * u;
          const double r = radius * v * (1.0 + 0.22 * v * std::cos(count * angle));
          const double h = height * std::cos(0.5 * glm::pi<double>() * v * v) + top;
          return dvec3(r * std::cos(angle), kVaultRadius + 0.17 - h, r * std::sin(angle));
        },
        40, 4, {1.0, 1.0});
  };
  Surface s = petals(0.155, 0.05, 8.0, 0.0);
  return s.add(petals(0.075, 0.04, 5.0, 0.045));
}

/// One bay of the skylight: a beam at either end is shared with the neighbour and added apart.
Surface glazingBars() {
  Surface s;
  for (int k = 1; k < 4; ++k) {
    const double at = kSkylightHalf * (0.5 * k - 1.0);
    s.add(box({at - 0.02, -0.05, -0.5 * kBay}, {at + 0.02, -0.005, 0.5 * kBay}));
    s.add(box({-kSkylightHalf, -0.05, at - 0.02}, {kSkylightHalf, -0.006, at + 0.02}));
  }
  return s;
}

/// Seen from below.
Surface ceilingPanel(double halfX, double halfZ) {
  return Surface().addQuad({-halfX, 0, -halfZ}, {halfX, 0, -halfZ}, {halfX, 0, halfZ}, {-halfX, 0, halfZ});
}

}  // namespace

void addVault(GltfWriter& gltf, const Palette& palette) {
  const MeshId cofferMesh = gltf.addMesh("coffer", coffer(), palette.vaultPlaster);
  const MeshId rosetteMesh = gltf.addMesh("rosette", rosette(), palette.rosette);
  const int rows = static_cast<int>(std::lround(2.0 * kHalfLength / kCofferLength));
  for (int row = 0; row < rows; ++row) {
    const double z = -kHalfLength + kCofferLength * (row + 0.5);
    for (int column = -4; column <= 4; ++column) {
      if (std::abs(column) <= 1 && std::abs(z) < kSkylightEnd) continue;
      const Placement at{.translation = {0.0, kSpringing, z}, .rollDegrees = -kCofferDegrees * column};
      const auto r = static_cast<std::size_t>(row + 1), c = static_cast<std::size_t>(column + 5);
      gltf.addNode(named("coffer", r, c), cofferMesh, at);
      gltf.addNode(named("rosette", r, c), rosetteMesh, at);
    }
  }
  const MeshId panel = gltf.addMesh("skylight", ceilingPanel(kSkylightHalf, 0.5 * kBay), palette.skylight);
  const MeshId bars = gltf.addMesh("glazing-bars", glazingBars(), palette.whitePaint);
  for (std::size_t i = 0; i < kBayZ.size(); ++i) {
    const Placement at{.translation = {0.0, kSkylightHeight, kBayZ[i]}};
    gltf.addNode(named("skylight", i + 1), panel, at);
    gltf.addNode(named("glazing-bars", i + 1), bars, at);
  }
  const MeshId across =
      gltf.addMesh("skylight-beam", box({-kSkylightHalf, -0.30, -0.15}, {kSkylightHalf, 0.02, 0.15}, 0.02),
                   palette.vaultPlaster);
  for (std::size_t i = 0; i < kColumnZ.size(); ++i) {
    gltf.addNode(named("skylight-beam", i + 1), across, {.translation = {0.0, kSkylightHeight, kColumnZ[i]}});
  }
  const MeshId edge =
      gltf.addMesh("skylight-edge", box({-0.12, -0.16, -kSkylightEnd}, {0.12, 0.25, kSkylightEnd}, 0.02),
                   palette.vaultPlaster);
  gltf.addNode("skylight-edge-left", edge, {.translation = {-kSkylightHalf, kSkylightHeight, 0.0}});
  gltf.addNode("skylight-edge-right", edge, {.translation = {kSkylightHalf, kSkylightHeight, 0.0}});
}

void addAisleCeilings(GltfWriter& gltf, const Palette& palette) {
  // Local frame: the middle of the ceiling of one bay, y = 0 its underside.
  const double halfX = 0.5 * (kWallX - kColumnX - kBeamHalf), middle = 0.5 * (kWallX + kColumnX + kBeamHalf);
  constexpr double kOpeningX = 0.95, kOpeningZ = 1.3, kRecess = 0.16;
  Surface ceiling;
  const double halfZ = 0.5 * kBay;
  ceiling.addQuad({-halfX, 0, -halfZ}, {halfX, 0, -halfZ}, {kOpeningX, 0, -kOpeningZ},
                  {-kOpeningX, 0, -kOpeningZ});
  ceiling.addQuad({halfX, 0, -halfZ}, {halfX, 0, halfZ}, {kOpeningX, 0, kOpeningZ},
                  {kOpeningX, 0, -kOpeningZ});
  ceiling.addQuad({halfX, 0, halfZ}, {-halfX, 0, halfZ}, {-kOpeningX, 0, kOpeningZ},
                  {kOpeningX, 0, kOpeningZ});
  ceiling.addQuad({-halfX, 0, halfZ}, {-halfX, 0, -halfZ}, {-kOpeningX, 0, -kOpeningZ},
                  {-kOpeningX, 0, kOpeningZ});
  // A moulding around the opening, from the recess to the underside and a little below it.
  ceiling.add(frame(2.0 * kOpeningX, 2.0 * kOpeningZ,
                    {{0.0, -kRecess}, {0.0, 0.02}, {0.02, 0.045}, {0.09, 0.045}, {0.12, 0.015}, {0.12, 0.0}}),
              turned(0.5 * glm::pi<double>(), {1, 0, 0}));
  const MeshId ceilingMesh = gltf.addMesh("aisle-ceiling", ceiling, palette.whitePaint);
  const MeshId end = gltf.addMesh("aisle-ceiling-end", ceilingPanel(halfX, 0.25 * kBay), palette.whitePaint);
  const MeshId beam =
      gltf.addMesh("aisle-beam", box({-halfX, -0.20, -0.22}, {halfX, 0.0, 0.22}, 0.02), palette.whitePaint);
  for (const double side : {-1.0, 1.0}) {
    const std::string_view name = side < 0.0 ? "left" : "right";
    const MeshId light = gltf.addMesh(named("laylight", name), ceilingPanel(kOpeningX, kOpeningZ),
                                      side < 0.0 ? palette.laylightLeft : palette.laylightRight);
    for (std::size_t i = 0; i < kBayZ.size(); ++i) {
      gltf.addNode(named("aisle-ceiling", name, i + 1), ceilingMesh,
                   {.translation = {side * middle, kAisleCeiling, kBayZ[i]}});
      gltf.addNode(named("laylight", name, i + 1), light,
                   {.translation = {side * middle, kAisleCeiling + kRecess, kBayZ[i]}});
    }
    for (std::size_t i = 0; i < kColumnZ.size(); ++i) {
      gltf.addNode(named("aisle-beam", name, i + 1), beam,
                   {.translation = {side * middle, kAisleCeiling, kColumnZ[i]}});
    }
    for (const double z : {-9.9, 9.9}) {
      gltf.addNode(named("aisle-ceiling", name, z < 0.0 ? "far" : "near"), end,
                   {.translation = {side * middle, kAisleCeiling, z}});
    }
  }
}

}  // namespace promenade::hall
