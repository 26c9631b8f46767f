// Benches, railings and lamps.

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "examples/hall/furnishings.h"
#include "examples/hall/layout.h"
#include "examples/hall/names.h"
#include "examples/hall/textures.h"

namespace promenade::hall {
namespace {

using glm::dvec2;
using glm::dvec3;

/// Along X, 1.8 m long: the wooden part. The cushion lies on it.
Surface benchFrame() {
  Surface s;
  for (const double x : {-0.78, 0.78}) {
    for (const double z : {-0.19, 0.19})
      s.add(box({x - 0.035, 0.0, z - 0.035}, {x + 0.035, 0.36, z + 0.035}, 0.005));
    s.add(box({x - 0.025, 0.10, -0.16}, {x + 0.025, 0.15, 0.16}, 0.004));
  }
  s.add(box({-0.76, 0.11, -0.02}, {0.76, 0.145, 0.02}, 0.004));
  s.add(box({-0.9, 0.36, -0.25}, {0.9, 0.41, 0.25}, 0.008));
  // The texture's grain runs along v: along the bench.
  for (dvec2& t : s.texCoords) t = {t.y, t.x};
  return s;
}

Surface benchCushion() {
  return box({-0.88, 0.41, -0.235}, {0.88, 0.485, 0.235}, 0.022);
}

/// A low barrier in front of the picture wall, along X.
Surface barrier(double length) {
  Surface s;
  const double half = 0.5 * length;
  for (const double x : {-half, 0.0, half}) {
    s.add(rod({x, 0.02, 0.0}, {x, 0.78, 0.0}, 0.011, 12));
    s.add(Surface().add(
        lathe(Profile({0.12, 0.0}).lineTo({0.12, 0.012}).lineTo({0.02, 0.03}).lineTo({0.0, 0.03}), 24),
        moved({x, 0.0, 0.0})));
    s.add(Surface().add(sphere(0.022, 16, 10), moved({x, 0.79, 0.0})));
  }
  for (const double y : {0.45, 0.74}) s.add(rod({-half, y, 0.0}, {half, y, 0.0}, 0.006, 10));
  return s;
}

/// A round railing with thin balusters.
Surface roundRailing(double radius) {
  Surface s;
  const auto ring = [radius](double y) {
    return [=](double u) { return dvec3(radius * std::sin(kTurn * u), y, radius * std::cos(kTurn * u)); };
  };
  s.add(tube(
      ring(0.86), [](double) { return 0.017; }, 96, 10, Ends::kClosed));
  s.add(tube(
      ring(0.10), [](double) { return 0.010; }, 96, 8, Ends::kClosed));
  constexpr int kBalusters = 48;
  for (int k = 0; k < kBalusters; ++k) {
    const double angle = kTurn * k / kBalusters;
    const dvec3 foot(radius * std::sin(angle), 0.0, radius * std::cos(angle));
    const bool post = k % 8 == 0;
    s.add(rod(foot + dvec3(0.0, post ? 0.0 : 0.10, 0.0), foot + dvec3(0.0, 0.86, 0.0), post ? 0.016 : 0.006,
              post ? 12 : 8));
  }
  return s;
}

constexpr double kLampRadius = 0.15;
constexpr double kLampHeight = 3.75;

/// What holds a globe under a beam; the globe's centre is the origin.
Surface lampFitting() {
  const double top = kColumnTop - kLampHeight;
  Surface s = rod({0.0, kLampRadius + 0.03, 0.0}, {0.0, top, 0.0}, 0.009, 10);
  s.add(lathe(
      Profile({0.075, kLampRadius - 0.022}).quarterTo({0.02, kLampRadius + 0.06}, Profile::Bulge::kOutward),
      24));
  s.add(lathe(
      Profile({0.0, top - 0.04}).lineTo({0.03, top - 0.04}).quarterTo({0.09, top}, Profile::Bulge::kOutward),
      24));
  return s;
}

}  // namespace

void addFurniture(GltfWriter& gltf, const Palette& palette) {
  const MeshId frameMesh = gltf.addMesh("bench", benchFrame(), palette.wood, dvec2(1.0 / kWoodMetres));
  const MeshId cushion = gltf.addMesh("bench-cushion", benchCushion(), palette.leather);
  const auto bench = [&](std::string_view name, const dvec3& at, double yaw) {
    gltf.addNode(named("bench", name), frameMesh, {.translation = at, .yawDegrees = yaw});
    gltf.addNode(named("bench-cushion", name), cushion, {.translation = at, .yawDegrees = yaw});
  };
  bench("pictures", {5.35, 0.0, 7.2}, 90.0);
  bench("nave", {-2.4, 0.0, 4.4}, 90.0);
  bench("aisle", {5.5, 0.0, 0.0}, 90.0);
  bench("windows", {-6.6, 0.0, -1.8}, 90.0);

  const MeshId barrierMesh = gltf.addMesh("barrier", barrier(2.6), palette.brass);
  for (const std::size_t bay : {0U, 1U, 2U, 4U}) {
    gltf.addNode(named("barrier", bay + 1), barrierMesh,
                 {.translation = {kWallX - 0.75, 0.0, kBayZ[bay]}, .yawDegrees = 90.0});
  }
  gltf.addNode("railing", gltf.addMesh("railing", roundRailing(1.15), palette.iron),
               {.translation = {0.0, 0.0, -1.6}});

  const MeshId globe = gltf.addMesh("lamp", sphere(kLampRadius, 16, 8), palette.lamp);
  const MeshId fitting = gltf.addMesh("lamp-fitting", lampFitting(), palette.bronze);
  for (const double side : {-1.0, 1.0}) {
    for (std::size_t i = 0; i < kBayZ.size(); ++i) {
      const std::string_view name = side < 0.0 ? "left" : "right";
      const Placement at{.translation = {side * kColumnX, kLampHeight, kBayZ[i]}};
      gltf.addNode(named("lamp", name, i + 1), globe, at);
      gltf.addNode(named("lamp-fitting", name, i + 1), fitting, at);
    }
  }
}

}  // namespace promenade::hall
