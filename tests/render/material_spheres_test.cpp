// Pictures of spheres under a sky with a soft sun, against the same pictures integrated direction by
// direction: a sphere does not see itself, so the light on it is one integral of its scattering function over
// the sky. Nothing is sampled in the references; everything between a material and a pixel is in the tests.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "src/render/bsdf.h"
#include "src/render/environment.h"
#include "src/render/normal_spread.h"
#include "src/render/path_renderer.h"
#include "tests/render/scenes.h"

namespace promenade::render {
namespace {

constexpr int kSide = 16;  // samples along the edge of the pictures

/// Blue above, brown below, and a sun of some 20 degrees: wide enough for the reference's steps.
Environment skyWithSun() {
  Environment sky;
  const Size size{64, 32};
  sky.radiance = RadianceMap(size);
  sky.rotationRadians = 0.7;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double theta = tests::kPi * (y + 0.5) / size.height;
      const double phi = 2.0 * tests::kPi * (x + 0.5) / size.width;
      const glm::vec3 d(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi));
      const float sun = std::exp(30.0f * (glm::dot(d, glm::normalize(glm::vec3(1.0f, 1.2f, 0.5f))) - 1.0f));
      const Rgb ground = d.y > 0.0f ? Rgb(0.2f, 0.3f, 0.5f) * (0.5f + d.y) : Rgb(0.1f, 0.08f, 0.05f);
      sky.radiance(x, y) = ground + Rgb(8.0f, 7.0f, 5.0f) * sun;
    }
  }
  return sky;
}

struct Look {
  std::string name;
  BsdfParameters bsdf;
};

Material materialOf(const BsdfParameters& p) {
  Material m;
  m.baseColor = glm::vec4(p.baseColor, 1.0f);
  m.metallic = p.metallic;
  m.roughness = p.roughness;
  m.ior = p.ior;
  m.specular = p.specular;
  m.specularColor = p.specularColor;
  m.clearcoat = p.clearcoat;
  m.clearcoatRoughness = p.clearcoatRoughness;
  return m;
}

std::vector<Look> looks() {
  std::vector<Look> all;
  BsdfParameters p;
  p.baseColor = {0.8f, 0.3f, 0.1f};
  p.roughness = 0.4f;
  all.push_back({"Plastic", p});
  p.specularColor = {0.2f, 1.0f, 0.5f};
  p.ior = 2.0f;
  p.roughness = 0.7f;
  all.push_back({"TintedLayer", p});
  p = BsdfParameters{};
  p.baseColor = {1.0f, 0.8f, 0.3f};
  p.metallic = 1.0f;
  p.roughness = 0.45f;
  all.push_back({"Gold", p});
  p.roughness = 1.0f;
  all.push_back({"RoughGold", p});
  p.metallic = 0.0f;
  p.clearcoat = 1.0f;
  p.clearcoatRoughness = 0.4f;
  all.push_back({"Coated", p});
  return all;
}

/// The sphere's picture without a renderer. `covered` is false near the outline, where facets and sphere
/// differ.
struct Reference {
  RadianceMap diffuse{Size{kSide, kSide}};
  RadianceMap viewDependent{Size{kSide, kSide}};
  Mask covered{Size{kSide, kSide}};
};

Reference integrate(const BsdfParameters& parameters, const EnvironmentLight& sky, const Camera& camera) {
  constexpr int kHeights = 96;
  constexpr int kAzimuths = 192;
  Reference result;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      // Unit sphere at the origin: |eye + t d|^2 = 1.
      const glm::dvec3 d = glm::normalize(camera.direction({x + 0.5, y + 0.5}));
      const double b = glm::dot(camera.pose().eye, d);
      const double c = glm::dot(camera.pose().eye, camera.pose().eye) - 1.0;
      if (b * b - c < 0.1) continue;
      const glm::dvec3 n = camera.pose().eye + d * (-b - std::sqrt(b * b - c));
      const glm::dvec3 tangent =
          glm::normalize(glm::cross(n, std::abs(n.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
      const glm::dvec3 bitangent = glm::cross(n, tangent);
      const glm::vec3 wo(-glm::dot(d, tangent), -glm::dot(d, bitangent), -glm::dot(d, n));
      // On a unit sphere normals turn by as much as a sample's footprint is long, across and along.
      const double distance = -b - std::sqrt(b * b - c);
      const double side =
          distance / (camera.focalPixels() * glm::length(camera.direction({x + 0.5, y + 0.5})));
      BsdfParameters look = parameters;
      const auto variance = static_cast<float>(side * side * (1.0 + 1.0 / (wo.z * wo.z)) / 12.0);
      broaden(look, variance, variance);
      glm::dvec3 diffuse(0.0);
      glm::dvec3 viewDependent(0.0);
      for (int i = 0; i < kHeights; ++i) {
        for (int j = 0; j < kAzimuths; ++j) {
          // Even in z = cos(theta) and azimuth: every cell has the same solid angle.
          const double z = (i + 0.5) / kHeights;
          const double phi = 2.0 * tests::kPi * (j + 0.5) / kAzimuths;
          const double sine = std::sqrt(1.0 - z * z);
          const glm::vec3 wi(sine * std::cos(phi), sine * std::sin(phi), z);
          const glm::dvec3 world = double{wi.x} * tangent + double{wi.y} * bitangent + double{wi.z} * n;
          const glm::dvec3 light(sky.radiance(glm::vec3(world)));
          const BsdfValue f = evaluateBsdf(look, wo, wi);
          diffuse += glm::dvec3(f.diffuse) * light;
          viewDependent += glm::dvec3(f.viewDependent) * light;
        }
      }
      const double cell = 2.0 * tests::kPi / (kHeights * kAzimuths);
      result.diffuse(x, y) = Rgb(diffuse * cell);
      result.viewDependent(x, y) = Rgb(viewDependent * cell);
      result.covered(x, y) = 1;
    }
  }
  return result;
}

class MaterialSphere : public testing::TestWithParam<Look> {};

/// Compares the mean of several independent frames with the reference: per pixel by its own standard error,
/// and all of the picture at once, where noise averages out and a wrong factor of half a per cent shows.
void expectSame(const std::vector<RadianceMap>& frames, const RadianceMap& reference, const Mask& covered,
                const char* part) {
  const auto count = static_cast<double>(frames.size());
  double whole = 0.0;
  double wholeReference = 0.0;
  int far = 0;
  int pixels = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      if (covered(x, y) == 0) continue;
      for (int c = 0; c < 3; ++c) {
        double mean = 0.0;
        for (const RadianceMap& f : frames) mean += f(x, y)[c] / count;
        double squares = 0.0;
        for (const RadianceMap& f : frames) squares += (f(x, y)[c] - mean) * (f(x, y)[c] - mean);
        const double standardError = std::sqrt(squares / (count - 1.0) / count);
        // One per cent for the facets of the sphere and the reference's steps.
        const double allowed = 4.0 * standardError + 0.01 * reference(x, y)[c] + 2e-3;
        far += std::abs(mean - reference(x, y)[c]) > allowed ? 1 : 0;
        ++pixels;
        whole += mean;
        wholeReference += reference(x, y)[c];
      }
    }
  }
  ASSERT_GT(pixels, 300) << part;
  // With 12 frames four estimated standard errors are exceeded once in 500 times.
  EXPECT_LE(far, pixels / 100) << part;
  EXPECT_NEAR(whole, wholeReference, 0.005 * wholeReference + 1e-3) << part;
}

TEST_P(MaterialSphere, LooksAsItsScatteringFunctionSays) {
  const Look& look = GetParam();
  Scene scene;
  scene.materials.push_back(materialOf(look.bsdf));
  tests::place(scene, tests::sphere({0, 0, 0}, 1.0f, 256, 128, 0));
  scene.environment = skyWithSun();
  const Camera camera = tests::lookingAt({0.5, 1.0, 4.0}, {0, 0, 0}, {kSide, kSide}, 0.5);
  const Reference reference = integrate(look.bsdf, EnvironmentLight(*scene.environment), camera);
  PathSettings settings;
  settings.pathsPerSample = 128;
  settings.maxBounces = 1;
  const auto renderer = makePathRenderer(scene, settings);
  std::vector<RadianceMap> diffuse;
  std::vector<RadianceMap> viewDependent;
  for (int frame = 0; frame < 12; ++frame) {
    Frame f = renderer->render(camera, frame);
    diffuse.push_back(std::move(f.diffuse));
    viewDependent.push_back(std::move(f.viewDependent));
  }
  expectSame(diffuse, reference.diffuse, reference.covered, "diffuse");
  expectSame(viewDependent, reference.viewDependent, reference.covered, "view-dependent");
}

INSTANTIATE_TEST_SUITE_P(Materials, MaterialSphere, testing::ValuesIn(looks()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace promenade::render
