// Sculptures and vases, and what they stand on.

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "examples/hall/furnishings.h"
#include "examples/hall/layout.h"
#include "examples/hall/names.h"
#include "examples/hall/textures.h"

namespace promenade::hall {
namespace {

using glm::dvec2;
using glm::dvec3;
using Bulge = Profile::Bulge;

constexpr double kPlinthHeight = 1.0;

/// A (p, q) torus knot of about unit size around +Z.
std::function<dvec3(double)> torusKnot(int p, int q, double tube) {
  return [=](double u) {
    const double angle = kTurn * u;
    const double r = 1.0 + tube * std::cos(q * angle);
    return dvec3(r * std::cos(p * angle), r * std::sin(p * angle), tube * std::sin(q * angle));
  };
}

Surface knot(int p, int q, double size, double thickness, int along, int around) {
  const auto curve = torusKnot(p, q, 0.42);
  return tube([=](double u) { return size * curve(u); }, [thickness](double) { return thickness; }, along,
              around, Ends::kClosed);
}

/// A band with three half turns in it, standing on its edge; thick, with rounded edges.
Surface moebius(double radius) {
  return parametric(
      [radius](double u, double v) {
        const double angle = kTurn * u, turn = 1.5 * angle, around = kTurn * v;
        // A superellipse section, wide across and thin through the band.
        const double c = std::cos(around), s = std::sin(around);
        const double across = 0.30 * std::copysign(std::pow(std::abs(c), 0.5), c),
                     through = 0.045 * std::copysign(std::pow(std::abs(s), 0.5), s);
        const dvec3 outward(std::cos(angle), std::sin(angle), 0.0), axis(0.0, 0.0, 1.0);
        const dvec3 side = std::cos(turn) * outward + std::sin(turn) * axis,
                    normal = -std::sin(turn) * outward + std::cos(turn) * axis;
        return radius * (outward + across * side + through * normal);
      },
      220, 24, {1.0, 1.0});
}

/// A leaning flame: a rounded triangle that turns and tapers on its way up.
Surface flame(double height) {
  return parametric(
      [height](double u, double v) {
        const double angle = kTurn * u,
                     taper = std::sqrt(std::max(0.0, 1.0 - v)) * (0.55 + 0.9 * v * (1.0 - v)) + 1e-4;
        const double r = 0.22 * taper * (1.0 + 0.28 * std::cos(3.0 * (angle - 3.2 * v)));
        const dvec2 lean(0.10 * std::sin(5.0 * v), 0.07 * std::sin(4.0 * v + 1.0) - 0.059);
        return dvec3(r * std::sin(angle) + lean.x, height * v, r * std::cos(angle) + lean.y);
      },
      72, 60, {1.0, 1.0});
}

Surface amphora() {
  Surface s = lathe(Profile({0.09, 0.0})
                        .lineTo({0.105, 0.02})
                        .curveThrough({{0.06, 0.07},
                                       {0.13, 0.22},
                                       {0.21, 0.46},
                                       {0.20, 0.60},
                                       {0.09, 0.72},
                                       {0.075, 0.84},
                                       {0.12, 0.92}},
                                      8)
                        .lineTo({0.10, 0.925})
                        .curveThrough({{0.06, 0.84}, {0.05, 0.72}}, 5),
                    56);
  for (const double side : {-1.0, 1.0}) {
    s.add(tube(
        [side](double u) {
          const double angle = glm::pi<double>() * (u - 0.5);
          return dvec3(side * (0.085 + 0.14 * std::cos(angle)), 0.73 + 0.13 * std::sin(angle), 0.0);
        },
        [](double) { return 0.014; }, 28, 10, Ends::kOpen));
  }
  return s;
}

/// A head-like pebble, as modern sculptors carve them: an egg with a brow and a nose ridge.
Surface muse() {
  return parametric(
      [](double u, double v) {
        const double longitude = kTurn * u, latitude = glm::pi<double>() * (v - 0.5);
        const dvec3 d(std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                      std::cos(latitude) * std::cos(longitude));
        const double ridge = 0.055 * std::exp(-60.0 * d.x * d.x - 6.0 * (d.y + 0.05) * (d.y + 0.05)) *
                             smoothStep(0.2, 0.7, d.z);
        const double brow = 0.02 * std::exp(-50.0 * (d.y - 0.28) * (d.y - 0.28)) * smoothStep(0.3, 0.8, d.z);
        const double eyes = -0.022 *
                            std::exp(-40.0 * (std::abs(d.x) - 0.33) * (std::abs(d.x) - 0.33) -
                                     40.0 * (d.y - 0.12) * (d.y - 0.12)) *
                            smoothStep(0.3, 0.7, d.z);
        const double r = 1.0 + 2.0 * (ridge + brow + eyes);
        return dvec3(0.19 * r * d.x, 0.30 + 0.28 * d.y * (1.0 + 0.08 * d.y), 0.225 * r * d.z + 0.03 * d.y);
      },
      112, 72, {1.0, 1.0});
}

Surface squarePlinth(double width, double height) {
  const double h = 0.5 * width;
  Surface s;
  s.add(box({-h - 0.05, 0.0, -h - 0.05}, {h + 0.05, 0.10, h + 0.05}, 0.008));
  s.add(box({-h, 0.10, -h}, {h, height - 0.07, h}, 0.008));
  s.add(box({-h - 0.035, height - 0.07, -h - 0.035}, {h + 0.035, height, h + 0.035}, 0.012));
  return s;
}

Surface roundPlinth(double radius, double height) {
  return lathe(Profile({radius + 0.10, 0.0})
                   .lineTo({radius + 0.10, 0.10})
                   .quarterTo({radius, 0.20}, Bulge::kInward)
                   .lineTo({radius, height - 0.16})
                   .quarterTo({radius + 0.07, height - 0.08}, Bulge::kInward)
                   .lineTo({radius + 0.07, height - 0.01})
                   .lineTo({radius + 0.06, height})
                   .lineTo({0.0, height}),
               72)
      .scaleTexture({3.0, 1.0});
}

/// Its lowest point brought to y = 0.
Surface standing(Surface s) {
  double low = s.positions.front().y;
  for (const dvec3& p : s.positions) low = std::min(low, p.y);
  return Surface().add(s, moved({0.0, -low, 0.0}));
}

}  // namespace

void addSculptures(GltfWriter& gltf, const Palette& palette) {
  const dvec2 marble(1.0 / kMarbleMetres);
  const MeshId plinth = gltf.addMesh("plinth", squarePlinth(0.62, kPlinthHeight), palette.darkMarble, marble);
  const MeshId round = gltf.addMesh("round-plinth", roundPlinth(0.55, 0.9), palette.paleMarble, marble);
  const MeshId goldKnot = gltf.addMesh("gold-knot", standing(knot(2, 3, 0.52, 0.125, 320, 28)), palette.gold);
  const MeshId marbleKnot =
      gltf.addMesh("marble-knot", standing(knot(3, 2, 0.23, 0.060, 260, 20)), palette.paleMarble, {3.0, 4.0});
  const MeshId band = gltf.addMesh("steel-band", standing(moebius(0.34)), palette.steel);
  const MeshId flameMesh = gltf.addMesh("bronze-flame", flame(1.15), palette.bronze);
  const MeshId amphoraMesh = gltf.addMesh("amphora", amphora(), palette.terracotta);
  const MeshId museMesh = gltf.addMesh("muse", muse(), palette.paleMarble, {1.0, 1.0});

  struct Exhibit {
    const char* name;
    MeshId mesh;
    dvec3 at;
    double yawDegrees;
    double scale;
  };
  // Beside the nave, in front of every other column, and in the aisles.
  const std::array<Exhibit, 7> exhibits{{
      {"bronze-flame", flameMesh, {-2.75, 0.0, 1.8}, 40.0, 1.0},
      {"muse", museMesh, {2.75, 0.0, -1.8}, -35.0, 1.0},
      {"steel-band", band, {-2.75, 0.0, -5.4}, 30.0, 1.0},
      {"marble-knot", marbleKnot, {2.75, 0.0, -5.4}, -20.0, 1.0},
      {"amphora-left", amphoraMesh, {-6.2, 0.0, 1.8}, 70.0, 1.0},
      {"amphora-right", amphoraMesh, {-6.2, 0.0, -5.4}, 20.0, 1.0},
      {"muse-aisle", museMesh, {6.6, 0.0, 1.8}, -120.0, 1.0},
  }};
  for (const Exhibit& e : exhibits) {
    gltf.addNode(named("plinth", e.name), plinth, {.translation = e.at});
    gltf.addNode(
        e.name, e.mesh,
        {.translation = e.at + dvec3(0.0, kPlinthHeight, 0.0), .yawDegrees = e.yawDegrees, .scale = e.scale});
  }
  const dvec3 centre(0.0, 0.0, -1.6);
  gltf.addNode("plinth-gold-knot", round, {.translation = centre});
  gltf.addNode("gold-knot", goldKnot, {.translation = centre + dvec3(0.0, 0.9, 0.0), .yawDegrees = 25.0});
  const dvec3 apse(0.0, 0.0, -kHalfLength - kApseReveal - 0.5);
  gltf.addNode("plinth-apse", round, {.translation = apse});
  gltf.addNode("amphora-apse", amphoraMesh,
               {.translation = apse + dvec3(0.0, 0.9, 0.0), .yawDegrees = 10.0, .scale = 1.7});
}

void addGlassCase(GltfWriter& gltf, const Palette& palette) {
  constexpr double kHalf = 0.45, kBottom = 0.92, kTop = 1.72, kEdge = 0.011;
  const dvec3 at(2.35, 0.0, 3.4);
  const double yaw = 0.0;
  gltf.addNode(
      "case-base",
      gltf.addMesh("case-base", squarePlinth(2.0 * kHalf, kBottom), palette.wood, dvec2(1.0 / kWoodMetres)),
      {.translation = at, .yawDegrees = yaw});
  Surface pane;
  pane.addQuad({-kHalf, kBottom, kHalf}, {kHalf, kBottom, kHalf}, {kHalf, kTop, kHalf},
               {-kHalf, kTop, kHalf});
  const MeshId side = gltf.addMesh("case-pane", pane, palette.glass);
  for (int k = 0; k < 4; ++k) {
    gltf.addNode(named("case-pane", static_cast<std::size_t>(k + 1)), side,
                 {.translation = at, .yawDegrees = yaw + 90.0 * k});
  }
  Surface lid;
  lid.addQuad({-kHalf, kTop, kHalf}, {kHalf, kTop, kHalf}, {kHalf, kTop, -kHalf}, {-kHalf, kTop, -kHalf});
  gltf.addNode("case-lid", gltf.addMesh("case-lid", lid, palette.glass),
               {.translation = at, .yawDegrees = yaw});
  Surface edges;
  for (const double x : {-kHalf, kHalf}) {
    for (const double z : {-kHalf, kHalf}) {
      edges.add(box({x - kEdge, kBottom, z - kEdge}, {x + kEdge, kTop + kEdge, z + kEdge}));
    }
    edges.add(box({x - kEdge, kTop - kEdge, -kHalf}, {x + kEdge, kTop + kEdge, kHalf}));
    edges.add(box({-kHalf, kTop - kEdge, x - kEdge}, {kHalf, kTop + kEdge, x + kEdge}));
  }
  gltf.addNode("case-edges", gltf.addMesh("case-edges", edges, palette.brass),
               {.translation = at, .yawDegrees = yaw});

  // The vase's texture runs once around and once from foot to lip.
  Surface vase = lathe(Profile({0.075, 0.0})
                           .curveThrough({{0.07, 0.03},
                                          {0.13, 0.14},
                                          {0.165, 0.28},
                                          {0.12, 0.40},
                                          {0.055, 0.46},
                                          {0.06, 0.52},
                                          {0.085, 0.55}},
                                         8),
                       72);
  double length = 0.0;
  for (const dvec2& t : vase.texCoords) length = std::max(length, t.y);
  vase.scaleTexture({1.0, 1.0 / length});
  vase.add(lathe(Profile({0.082, 0.552}).curveThrough({{0.05, 0.51}, {0.045, 0.44}}, 6), 72));
  gltf.addNode("porcelain-vase", gltf.addMesh("porcelain-vase", vase, palette.porcelain),
               {.translation = at + dvec3(-0.18, kBottom, -0.10), .yawDegrees = 30.0});
  const MeshId block = gltf.addMesh("case-block", box({-0.11, 0.0, -0.11}, {0.11, 0.16, 0.11}, 0.006),
                                    palette.paleMarble, dvec2(1.0 / kMarbleMetres));
  gltf.addNode("case-block", block, {.translation = at + dvec3(0.22, kBottom, 0.10), .yawDegrees = 20.0});
  gltf.addNode("case-knot",
               gltf.addMesh("case-knot", standing(knot(2, 5, 0.105, 0.020, 280, 16)), palette.gold),
               {.translation = at + dvec3(0.22, kBottom + 0.16, 0.10), .yawDegrees = 35.0});
}

}  // namespace promenade::hall
