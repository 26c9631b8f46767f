// Scenes whose radiance is known in closed form, through the whole path tracer.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>

#include "src/render/bsdf.h"
#include "src/render/path_renderer.h"
#include "tests/render/scenes.h"

namespace promenade::render {
namespace {

using tests::kPi;
using tests::lookingAt;

PathSettings paths(int count, int bounces) {
  PathSettings settings;
  settings.pathsPerSample = count;
  settings.maxBounces = bounces;
  return settings;
}

double meanOf(const Scene& scene, const Camera& camera, const PathSettings& settings) {
  return tests::meanRadiance(makePathRenderer(scene, settings)->render(camera, 0)).y;
}

/// A floor y = 0 of the given albedo, seen from above: one sample at the origin.
Scene floorScene(float albedo) {
  Scene scene;
  scene.materials.push_back(tests::diffuseMaterial(Rgb(albedo)));
  tests::place(scene, tests::quad({-50.0f, 0.0f, 50.0f}, {100.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -100.0f}, 0));
  return scene;
}
Camera atTheOrigin(int samples) {
  return lookingAt({0.3, 3.0, 2.0}, {0, 0, 0}, {samples, samples}, 0.0005);
}

// --- White furnace: under a sky of radiance 1, a body that absorbs nothing is invisible. ---

using FurnaceCase =
    std::tuple<const char*, float, float, float, float>;  // name, metallic, roughness, tolerance below, above
class WhiteFurnace : public testing::TestWithParam<FurnaceCase> {};

TEST_P(WhiteFurnace, ABodyThatAbsorbsNothingIsAsBrightAsTheSky) {
  const auto& [name, metallic, roughness, below, above] = GetParam();
  Scene scene;
  Material m;
  m.metallic = metallic;
  m.roughness = roughness;
  scene.materials.push_back(m);
  tests::place(scene, tests::sphere({0, 0, 0}, 1.0f, 96, 48, 0));
  scene.environment = tests::uniformSky(Rgb(1.0f));
  const double mean = meanOf(scene, lookingAt({0, 0, 4}, {0, 0, 0}, {24, 24}, 0.35), paths(64, 16));
  EXPECT_GT(mean, 1.0 - below);
  EXPECT_LT(mean, 1.0 + above);
}

INSTANTIATE_TEST_SUITE_P(Materials, WhiteFurnace,
                         testing::Values(FurnaceCase{"Mirror", 1.0f, 0.0f, 0.01f, 0.002f},
                                         FurnaceCase{"PolishedMetal", 1.0f, 0.15f, 0.02f, 0.01f},
                                         FurnaceCase{"SatinMetal", 1.0f, 0.5f, 0.02f, 0.01f},
                                         FurnaceCase{"RoughMetal", 1.0f, 1.0f, 0.02f, 0.01f},
                                         FurnaceCase{"SmoothDielectric", 0.0f, 0.0f, 0.02f, 0.01f},
                                         FurnaceCase{"SatinDielectric", 0.0f, 0.4f, 0.02f, 0.01f},
                                         FurnaceCase{"RoughDielectric", 0.0f, 1.0f, 0.02f, 0.01f}),
                         [](const auto& tested) { return std::string(std::get<0>(tested.param)); });

TEST(WhiteFurnaceLambert, IsExactWithoutNoiseInTheSky) {
  Scene scene;
  scene.materials.push_back(tests::diffuseMaterial(Rgb(1.0f)));
  tests::place(scene, tests::sphere({0, 0, 0}, 1.0f, 96, 48, 0));
  scene.environment = tests::uniformSky(Rgb(1.0f));
  EXPECT_NEAR(meanOf(scene, lookingAt({0, 0, 4}, {0, 0, 0}, {24, 24}, 0.35), paths(64, 4)), 1.0, 3e-3);
}

TEST(WhiteFurnaceGlass, ASolidThatRefractsIsInvisibleUnderAUniformSky) {
  Scene scene;
  Material m;
  m.metallic = 0.0f;
  m.roughness = 0.0f;
  m.transmission = 1.0f;
  m.thickness = 1.0f;
  scene.materials.push_back(m);
  tests::place(scene, tests::sphere({0, 0, 0}, 1.0f, 96, 48, 0));
  scene.environment = tests::uniformSky(Rgb(1.0f));
  EXPECT_NEAR(meanOf(scene, lookingAt({0, 0, 4}, {0, 0, 0}, {24, 24}, 0.35), paths(64, 40)), 1.0, 0.01);
}

// --- Irradiance of a floor ---

TEST(Irradiance, OfAPointLightFallsWithSquareAndCosine) {
  Scene scene = floorScene(0.5f);
  PunctualLight light;
  light.intensity = Rgb(10.0f);
  light.position = {1.0f, 2.0f, 0.0f};
  scene.lights.push_back(light);
  // E = I cos / d^2 = 10 * (2 / sqrt(5)) / 5; L = albedo E / pi.
  const double expected = 0.5 / kPi * 10.0 * (2.0 / std::sqrt(5.0)) / 5.0;
  EXPECT_NEAR(meanOf(scene, atTheOrigin(1), paths(1, 1)), expected, 1e-3 * expected);
}

TEST(Irradiance, OfADirectionalLightIsItsLuxTimesTheCosine) {
  Scene scene = floorScene(0.25f);
  PunctualLight light;
  light.type = PunctualLight::Type::kDirectional;
  light.intensity = Rgb(3.0f);
  light.direction = glm::normalize(glm::vec3(1.0f, -1.0f, 0.0f));
  scene.lights.push_back(light);
  const double expected = 0.25 / kPi * 3.0 * std::sqrt(0.5);
  EXPECT_NEAR(meanOf(scene, atTheOrigin(1), paths(1, 1)), expected, 1e-4 * expected);
}

TEST(Irradiance, OfASpotIsFullInsideItsInnerConeAndNothingOutsideItsOuterOne) {
  PunctualLight light;
  light.type = PunctualLight::Type::kSpot;
  light.intensity = Rgb(10.0f);
  light.position = {0.0f, 2.0f, 0.0f};
  light.innerConeRadians = 0.2f;
  light.outerConeRadians = 0.4f;
  const auto lit = [&](double angle) {
    Scene scene = floorScene(1.0f);
    light.direction = glm::vec3(std::sin(angle), -std::cos(angle), 0.0);
    scene.lights.push_back(light);
    return meanOf(scene, atTheOrigin(1), paths(1, 1));
  };
  const double full = 1.0 / kPi * 10.0 / 4.0;
  EXPECT_NEAR(lit(0.0), full, 1e-3 * full);
  EXPECT_NEAR(lit(0.15), full, 1e-3 * full);
  EXPECT_EQ(lit(0.45), 0.0);
  // KHR_lights_punctual: ((cos a - cos outer) / (cos inner - cos outer))^2.
  const double t = (std::cos(0.3) - std::cos(0.4)) / (std::cos(0.2) - std::cos(0.4));
  EXPECT_NEAR(lit(0.3), full * t * t, 2e-3 * full);
}

TEST(Irradiance, OfASphereLightIsThatOfItsSolidAngle) {
  Scene scene = floorScene(0.5f);
  scene.materials.push_back(tests::emitter(Rgb(4.0f)));
  const float radius = 0.5f;
  tests::place(scene, tests::sphere({0.0f, 2.0f, 0.0f}, radius, 128, 64, 1));
  // A sphere of radiance L right above, at distance d: E = pi L (r/d)^2. Its facets lie inside it by 1 -
  // cos(pi/128) = 3e-4 at most, and area goes with the square.
  const double expected = 0.5 / kPi * kPi * 4.0 * (0.25 / 4.0);
  EXPECT_NEAR(meanOf(scene, atTheOrigin(8), paths(256, 1)), expected, 6e-3 * expected);
}

TEST(Irradiance, OfAUniformSkyOnAnOpenFloorIsPi) {
  Scene scene = floorScene(0.5f);
  scene.environment = tests::uniformSky(Rgb(2.0f));
  EXPECT_NEAR(meanOf(scene, atTheOrigin(4), paths(1024, 1)), 0.5 * 2.0, 2e-3);
}

TEST(Irradiance, OfManyLightsIsTheSumOfTheirs) {
  // Emissive spheres of several sizes, point lights and a directional light, alone and together.
  const auto add = [](Scene& scene, int which) {
    const auto k = static_cast<float>(which);
    if (which < 4) {
      scene.materials.push_back(tests::emitter(Rgb(1.0f + 3.0f * k)));
      tests::place(scene,
                   tests::sphere({2.0f * std::cos(k), 1.0f + 0.5f * k, 2.0f * std::sin(k)}, 0.2f + 0.05f * k,
                                 12, 6, static_cast<int>(scene.materials.size()) - 1));
      return;
    }
    PunctualLight light;
    light.intensity = Rgb(k - 3.0f);
    light.position = {k - 6.0f, 3.0f, 1.0f};
    light.direction = glm::normalize(glm::vec3(0.3f, -1.0f, 0.2f));
    if (which == 7) light.type = PunctualLight::Type::kDirectional;
    scene.lights.push_back(light);
  };
  double sum = 0.0;
  Scene all = floorScene(0.5f);
  for (int which = 0; which < 8; ++which) {
    Scene one = floorScene(0.5f);
    add(one, which);
    add(all, which);
    sum += meanOf(one, atTheOrigin(4), paths(256, 1));
  }
  EXPECT_NEAR(meanOf(all, atTheOrigin(8), paths(1024, 1)), sum, 0.01 * sum);
}

TEST(Irradiance, OfTheSkyThroughASmallWindowIsThatOfTheWindow) {
  // A dark box of 4 m with a window of 0.4 m in its ceiling, right above: the sky through it is as a light of
  // that shape.
  Scene window = floorScene(0.5f);
  window.materials.push_back(tests::diffuseMaterial(Rgb(0.0f)));
  const float w = 0.2f;
  for (const auto& [x0, x1, z0, z1] : {std::tuple{-50.0f, -w, -50.0f, 50.0f},
                                       {w, 50.0f, -50.0f, 50.0f},
                                       {-w, w, -50.0f, -w},
                                       {-w, w, w, 50.0f}}) {
    tests::place(window, tests::quad({x0, 3.5f, z0}, {x1 - x0, 0, 0}, {0, 0, z1 - z0}, 1));
  }
  for (const float x : {-50.0f, 50.0f}) {
    tests::place(window, tests::quad({x, 0.0f, -50.0f}, {0.0f, 3.5f, 0.0f}, {0.0f, 0.0f, 100.0f}, 1));
    tests::place(window, tests::quad({-50.0f, 0.0f, x}, {0.0f, 3.5f, 0.0f}, {100.0f, 0.0f, 0.0f}, 1));
  }
  window.environment = tests::uniformSky(Rgb(8.0f));
  const Camera camera = lookingAt({0.3, 3.0, 2.0}, {0, 0, 0}, {8, 8}, 0.0005);
  // Differential form factor of a rectangle a x b above its corner at height h (Howell, B-3), four of them:
  // F = (1/2pi) (A/sqrt(1+A^2) atan(B/sqrt(1+A^2)) + B/sqrt(1+B^2) atan(A/sqrt(1+B^2))) with A = a/h, B =
  // b/h.
  const double a = 0.2 / 3.5, r = a / std::sqrt(1.0 + a * a);
  const double f = 4.0 / (2.0 * kPi) * 2.0 * r * std::atan(r);
  const double expected = 0.5 * 8.0 * f;
  EXPECT_NEAR(meanOf(window, camera, paths(8192, 1)), expected, 0.02 * expected);
}

// --- Form factors: the mean radiance of a square of albedo a lit by one of radiance L is a L F. ---

double meanOverUnitSquare(const Scene& scene, const glm::dvec3& up, const glm::dvec3& eye,
                          double fieldOfView) {
  return meanOf(scene, lookingAt(eye, {0.5, 0.0, 0.5}, {32, 32}, fieldOfView, up), paths(64, 1));
}

TEST(FormFactor, OfParallelUnitSquaresAtUnitDistanceIsOneFifth) {
  Scene scene;
  scene.materials.push_back(tests::diffuseMaterial(Rgb(1.0f)));
  Material front = tests::emitter(Rgb(1.0f));
  front.doubleSided = false;  // shines down only
  scene.materials.push_back(front);
  tests::place(scene, tests::quad({0, 0, 1}, {1, 0, 0}, {0, 0, -1}, 0));
  tests::place(scene, tests::quad({0, 1, 0}, {1, 0, 0}, {0, 0, 1}, 1));
  // From just under the emitter a field of view of 2 atan(0.5/0.99) covers exactly the receiver.
  const double fieldOfView = 2.0 * std::atan(0.5 / 0.99);
  const double mean = meanOverUnitSquare(scene, {0, 0, -1}, {0.5, 0.99, 0.5}, fieldOfView);
  // Howell, catalogue C-11 with X = Y = 1: F = 2/(pi) (ln sqrt(4/3) + 2 sqrt2 atan(1/sqrt2) - 2 atan 1) =
  // 0.19982.
  const double f = 2.0 / kPi *
                   (0.5 * std::log(4.0 / 3.0) + 2.0 * std::sqrt(2.0) * std::atan(1.0 / std::sqrt(2.0)) -
                    2.0 * std::atan(1.0));
  EXPECT_NEAR(f, 0.19982, 1e-5);
  EXPECT_NEAR(mean, f, 1.5e-3);
}

TEST(FormFactor, OfPerpendicularUnitSquaresWithACommonEdgeIsOneFifth) {
  Scene scene;
  scene.materials.push_back(tests::diffuseMaterial(Rgb(1.0f)));
  scene.materials.push_back(tests::emitter(Rgb(1.0f)));
  tests::place(scene, tests::quad({0, 0, 1}, {1, 0, 0}, {0, 0, -1}, 0));
  tests::place(scene, tests::quad({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1));
  const double fieldOfView = 2.0 * std::atan(0.5 / 20.0);
  const double mean = meanOverUnitSquare(scene, {0, 0, -1}, {0.5, 20.0, 0.5}, fieldOfView);
  // Howell, catalogue C-14 with H = W = 1: F = (1/pi) (2 atan 1 - sqrt2 atan(1/sqrt2) + ln(3/4)/4) = 0.20004.
  const double f =
      1.0 / kPi *
      (2.0 * std::atan(1.0) - std::sqrt(2.0) * std::atan(1.0 / std::sqrt(2.0)) + 0.25 * std::log(0.75));
  EXPECT_NEAR(f, 0.20004, 1e-5);
  EXPECT_NEAR(mean, f, 1.5e-3);
}

// --- Many bounces ---

TEST(ClosedBox, OfAlbedoAAndEmissionEShinesWithEOverOneMinusA) {
  for (const float albedo : {0.2f, 0.5f, 0.8f}) {
    Scene scene;
    Material m = tests::diffuseMaterial(Rgb(albedo));
    m.emission = Rgb(1.0f, 0.5f, 0.25f);
    scene.materials.push_back(m);
    const glm::vec3 x(2, 0, 0), y(0, 2, 0), z(0, 0, 2), o(-1, -1, -1);
    for (const auto& [corner, u, v] :
         {std::tuple{o, x, y}, {o + z, x, y}, {o, y, z}, {o + x, y, z}, {o, z, x}, {o + y, z, x}}) {
      tests::place(scene, tests::quad(corner, u, v, 0));
    }
    // After n scatterings a^n is missing; with 100 that is below 1e-9 even for 0.8.
    const auto renderer = makePathRenderer(scene, paths(64, 100));
    const glm::dvec3 mean =
        tests::meanRadiance(renderer->render(lookingAt({0, 0, 0}, {0.3, 0.2, 1.0}, {16, 16}, 1.5), 0));
    for (int c = 0; c < 3; ++c) {
      const double expected = m.emission[c] / (1.0 - albedo);
      EXPECT_NEAR(mean[c], expected, 6e-3 * expected) << "albedo " << albedo;
    }
  }
}

// --- Passing straight through ---

Scene floorUnderPane(const Material& pane, float halfWidth) {
  Scene scene = floorScene(0.5f);
  scene.materials.push_back(tests::emitter(Rgb(4.0f)));
  scene.materials.push_back(pane);
  tests::place(scene, tests::sphere({0.0f, 2.0f, 0.0f}, 0.5f, 64, 32, 1));
  tests::place(scene, tests::quad({-halfWidth, 1.0f, halfWidth}, {2.0f * halfWidth, 0.0f, 0.0f},
                                  {0.0f, 0.0f, -2.0f * halfWidth}, 2));
  return scene;
}
Camera underThePane() {
  return lookingAt({0.3, 0.5, 0.4}, {0, 0, 0}, {8, 8}, 0.001);
}

TEST(Passage, ABlendedSurfaceLetsOneMinusAlphaThrough) {
  Material pane = tests::diffuseMaterial(Rgb(0.0f));
  pane.alphaMode = AlphaMode::kBlend;
  pane.baseColor.a = 0.0f;
  const double open = meanOf(floorUnderPane(pane, 1.0f), underThePane(), paths(256, 1));
  pane.baseColor.a = 0.75f;
  const double quarter = meanOf(floorUnderPane(pane, 1.0f), underThePane(), paths(256, 1));
  EXPECT_NEAR(open, 0.5 * 4.0 * 0.25 / 4.0, 0.01 * 0.125);
  EXPECT_NEAR(quarter, 0.25 * open, 0.02 * open);
}

TEST(Passage, AMaskCutsHolesForCameraAndShadowRays) {
  Material pane = tests::diffuseMaterial(Rgb(0.0f));
  pane.alphaMode = AlphaMode::kMask;
  pane.baseColor.a = 0.4f;  // below the cutoff: nothing is there
  EXPECT_NEAR(meanOf(floorUnderPane(pane, 1.0f), underThePane(), paths(256, 1)), 0.125, 0.01 * 0.125);
  const Scene scene = floorUnderPane(pane, 1.0f);
  const Visibility v =
      makePathRenderer(scene, {})->visibility(lookingAt({0, 1.4, 0.5}, {0, 0, 0}, {3, 3}, 0.01));
  EXPECT_EQ(v.item(1, 1), 1u);
  pane.baseColor.a = 0.6f;
  EXPECT_EQ(meanOf(floorUnderPane(pane, 30.0f), underThePane(), paths(16, 1)), 0.0);
}

TEST(Passage, LightThroughAWindowPaneIsCountedOnceByBothStrategies) {
  // Whatever part t of the light a pane lets through at right angles: the floor lit through it and the light
  // seen through it must dim by the same t.
  Material pane;
  pane.metallic = 0.0f;
  pane.roughness = 0.0f;
  pane.transmission = 1.0f;
  Scene scene = floorScene(0.5f);
  scene.materials.push_back(tests::diffuseMaterial(Rgb(0.0f)));
  scene.materials.push_back(pane);
  // Small and far: every ray meets the pane at nearly a right angle.
  scene.materials.push_back(tests::emitter(Rgb(400.0f)));
  tests::place(scene, tests::sphere({0.0f, 20.0f, 0.0f}, 1.0f, 64, 32, 3));
  const double open = meanOf(scene, underThePane(), paths(64, 2));
  tests::place(scene, tests::quad({-5.0f, 1.0f, 5.0f}, {10.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -10.0f}, 2));
  const double through = meanOf(scene, underThePane(), paths(64, 2));
  const Camera up = lookingAt({0.0, 0.5, 0.0}, {0.0, 20.0, 0.0}, {4, 4}, 0.001, {0, 0, 1});
  const double seen = meanOf(scene, up, paths(4096, 2)) / 400.0;
  EXPECT_GT(seen, 0.85);
  EXPECT_LT(seen, 1.0);
  EXPECT_NEAR(through / open, seen, 0.02);
}

TEST(Passage, ShadowRaysReadTheTexturesOfAPane) {
  // Without its specular layer a pane reflects nothing; under a coat it loses what the coat reflects, 0.04.
  const auto through = [](const std::array<std::uint8_t, 4>& specular,
                          const std::array<std::uint8_t, 4>& coat) {
    Scene scene = floorScene(0.5f);
    Material pane;
    pane.metallic = 0.0f;
    pane.roughness = 0.0f;
    pane.transmission = 1.0f;
    pane.specularTexture = tests::uniformTexture(scene, specular);
    pane.clearcoat = 1.0f;
    pane.clearcoatTexture = tests::uniformTexture(scene, coat);
    scene.materials.push_back(pane);
    scene.materials.push_back(tests::emitter(Rgb(400.0f)));
    tests::place(scene, tests::sphere({0.0f, 20.0f, 0.0f}, 1.0f, 64, 32, 2));
    const double open = meanOf(scene, underThePane(), paths(64, 1));
    tests::place(scene, tests::quad({-5.0f, 1.0f, 5.0f}, {10.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -10.0f}, 1));
    return meanOf(scene, underThePane(), paths(64, 1)) / open;
  };
  EXPECT_NEAR(through({255, 255, 255, 0}, {0, 0, 0, 255}), 1.0, 2e-3);
  EXPECT_NEAR(through({255, 255, 255, 0}, {255, 0, 0, 255}), 0.96, 2e-3);
}

TEST(Clearcoat, IsNotBentByTheNormalMapUnderIt) {
  // A black wall with a smooth coat, seen at right angles, mirrors what lies behind the camera, whatever the
  // base's normal map says; the coat's own map turns it away. Sky: white on the camera's side, black behind
  // the wall and to the sides.
  Scene scene;
  Material m = tests::diffuseMaterial(Rgb(0.0f));
  m.clearcoat = 1.0f;
  Texture tilted = tests::uniformTexture(scene, {230, 128, 180, 255});  // about 63 degrees
  tilted.encoding = TexelEncoding::kNormal;
  Environment sky;
  sky.radiance = RadianceMap(Size{64, 32}, Rgb(0.0f));
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      const double theta = kPi * (y + 0.5) / 32.0;
      const double phi = 2.0 * kPi * ((x + 0.5) / 64.0 - 0.5);
      const glm::dvec3 d(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi));
      if (d.z > 0.9) sky.radiance(x, y) = Rgb(1.0f);
    }
  }
  scene.environment = std::move(sky);
  scene.materials.push_back(m);
  Mesh wall = tests::quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, 0);
  wall.tangents.assign(4, {1.0f, 0.0f, 0.0f, 1.0f});
  tests::place(scene, std::move(wall));
  const Camera camera = lookingAt({0, 0, 5}, {0, 0, 0}, {4, 4}, 0.01);
  scene.materials[0].normalTexture = tilted;
  EXPECT_NEAR(meanOf(scene, camera, paths(16, 2)), 0.04, 1e-3);
  scene.materials[0].clearcoatNormalTexture = tilted;
  EXPECT_NEAR(meanOf(scene, camera, paths(16, 2)), 0.0, 1e-3);
}

TEST(Passage, AWideLightThroughAPaneIsFoundByBothStrategiesWithWeightsThatSumToOne) {
  // A blended pane over the whole floor lets the same part through in every direction: E = (1 - alpha) pi L.
  // Under a uniform sky both strategies find the light equally often.
  Material pane = tests::diffuseMaterial(Rgb(0.0f));
  pane.alphaMode = AlphaMode::kBlend;
  pane.baseColor.a = 0.5f;
  Scene scene = floorScene(0.5f);
  scene.materials.push_back(pane);
  tests::place(scene, tests::quad({-45.0f, 0.01f, 45.0f}, {90.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -90.0f}, 1));
  scene.environment = tests::uniformSky(Rgb(1.0f));
  const Camera between = lookingAt({0.0, 0.009, 0.001}, {0, 0, 0}, {8, 8}, 0.001);
  EXPECT_NEAR(meanOf(scene, between, paths(256, 1)), 0.25, 2.5e-3);
}

TEST(Passage, AbsorptionInASolidFollowsItsAttenuation) {
  // A block of index 1 (no reflection, no refraction), 2 m thick, of attenuation colour c at distance 1 m:
  // c^2.
  Scene scene;
  Material m;
  m.metallic = 0.0f;
  m.roughness = 0.0f;
  m.ior = 1.0f;
  m.specular = 0.0f;
  m.transmission = 1.0f;
  m.thickness = 1.0f;
  m.attenuationColor = Rgb(0.5f, 0.8f, 1.0f);
  m.attenuationDistanceMetres = 1.0f;
  scene.materials.push_back(m);
  tests::place(scene, tests::quad({-9, -9, 1}, {18, 0, 0}, {0, 18, 0}, 0));
  tests::place(scene, tests::quad({-9, -9, -1}, {0, 18, 0}, {18, 0, 0}, 0));
  scene.environment = tests::uniformSky(Rgb(1.0f));
  const auto renderer = makePathRenderer(scene, paths(64, 8));
  const glm::dvec3 mean =
      tests::meanRadiance(renderer->render(lookingAt({0, 0, 5}, {0, 0, 0}, {4, 4}, 0.01), 0));
  EXPECT_NEAR(mean.x, 0.25, 5e-3);
  EXPECT_NEAR(mean.y, 0.64, 5e-3);
  EXPECT_NEAR(mean.z, 1.0, 5e-3);
}

TEST(Passage, OneScatteringUnderAPaneGetsWhatThePaneLetsThroughFromEveryDirection) {
  Material pane;
  pane.metallic = 0.0f;
  pane.roughness = 0.0f;
  pane.transmission = 1.0f;
  Scene scene = floorScene(0.5f);
  scene.materials.push_back(pane);
  tests::place(scene, tests::quad({-45.0f, 0.5f, 45.0f}, {90.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -90.0f}, 1));
  scene.environment = tests::uniformSky(Rgb(1.0f));
  // L = albedo * mean of the transmittance over the cosine-weighted hemisphere: the integral of t(c) 2c dc
  // over [0, 1].
  BsdfParameters parameters;
  parameters.roughness = 0.0f;
  parameters.transmission = 1.0f;
  double mean = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double c = (i + 0.5) / 1000.0;
    mean += straightTransmittance(parameters, static_cast<float>(c)).y * 2.0 * c / 1000.0;
  }
  const Camera camera = lookingAt({0.1, 0.3, 0.1}, {0, 0, 0}, {8, 8}, 0.001);
  EXPECT_NEAR(meanOf(scene, camera, paths(256, 1)), 0.5 * mean, 0.01 * mean);
}

TEST(Passage, StraightGlassLightsTheFloorBelowASlabByChoiceAndByChance) {
  // A slab of two refracting surfaces between floor and a uniform sky. Refracted or not, a slab that loses
  // little light leaves the floor nearly as bright as the open sky would: at most a L, less what the surfaces
  // reflect, about 0.1 of it diffusely (0.09 for one surface of index 1.5), part of which comes back.
  Scene scene = floorScene(0.5f);
  Material glass;
  glass.metallic = 0.0f;
  glass.roughness = 0.0f;
  glass.transmission = 1.0f;
  glass.thickness = 0.5f;
  scene.materials.push_back(glass);
  tests::place(scene, tests::quad({-45.0f, 1.5f, 45.0f}, {90.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -90.0f}, 1));
  tests::place(scene, tests::quad({-45.0f, 1.0f, 45.0f}, {0.0f, 0.0f, -90.0f}, {90.0f, 0.0f, 0.0f}, 1));
  scene.environment = tests::uniformSky(Rgb(1.0f));
  PathSettings settings = paths(1024, 12);
  const double refracted = meanOf(scene, underThePane(), settings);
  settings.solidGlass = SolidGlass::kStraightAfterScattering;
  const double straight = meanOf(scene, underThePane(), settings);
  EXPECT_GT(refracted, 0.35);
  EXPECT_LT(refracted, 0.5);
  EXPECT_NEAR(straight, refracted, 0.06);
}

TEST(Unlit, ShowsItsBaseColourWhateverTheLight) {
  Scene scene;
  Material m;
  m.unlit = true;
  m.baseColor = {0.2f, 0.4f, 0.6f, 1.0f};
  scene.materials.push_back(m);
  tests::place(scene, tests::quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, 0));
  scene.environment = tests::uniformSky(Rgb(5.0f));
  const Frame frame = makePathRenderer(scene, {})->render(lookingAt({0, 0, 5}, {0, 0, 0}, {3, 3}), 0);
  for (const Rgb& pixel : frame.diffuse.pixels()) EXPECT_EQ(pixel, Rgb(0.2f, 0.4f, 0.6f));
  for (const Rgb& pixel : frame.viewDependent.pixels()) EXPECT_EQ(pixel, Rgb(0.0f));
}

}  // namespace
}  // namespace promenade::render
