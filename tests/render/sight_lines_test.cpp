// What is seen through panes and in mirrors: closed forms, and no noise where there is nothing to choose.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "src/render/path_renderer.h"
#include "src/render/scattering_surface.h"
#include "tests/render/scenes.h"

namespace promenade::render {
namespace {

Material clearPane() {
  Material m;
  m.metallic = 0.0f;
  m.roughness = 0.0f;
  m.transmission = 1.0f;
  m.doubleSided = true;
  return m;
}

PathSettings settingsFor(int paths, std::uint64_t seed = 1) {
  PathSettings settings;
  settings.pathsPerSample = paths;
  settings.maxBounces = 16;
  settings.seed = seed;
  return settings;
}

/// Panes across the z axis, seen at an angle to it of which `cosine` is the cosine, from z = 10.
struct StackOfPanes {
  static constexpr float kWide = 400.0f;
  explicit StackOfPanes(int count, double cosine) : cosineOut(cosine) {
    scene.materials = {clearPane(), tests::emitter(Rgb(1.0f))};
    for (int i = 0; i < count; ++i) acrossZ(-static_cast<float>(i), 0);
  }
  void acrossZ(float z, int material) {
    tests::place(scene,
                 tests::quad({-kWide, -kWide, z}, {2.0f * kWide, 0, 0}, {0, 2.0f * kWide, 0}, material));
  }
  [[nodiscard]] Frame seen(const PathSettings& settings) const {
    const glm::dvec3 eye(10.0 * std::sqrt(1.0 - cosineOut * cosineOut) / cosineOut, 0.0, 10.0);
    return makePathRenderer(scene, settings)->render(tests::lookingAt(eye, {0, 0, 0}, {16, 16}, 1e-4), 0);
  }
  double cosineOut;
  Scene scene;
};

class Panes : public testing::TestWithParam<int> {};

// Schlick's reflectance of index 1.5 is 0.2 where (1 - cosine)^5 = 1/6: cosine 0.30117. Light that goes back
// and forth between n panes that absorb nothing: T = (1 - R) / (1 + (n - 1) R), the rest is reflected
// (Stokes 1862).
constexpr double kCosine = 0.30117, kReflectance = 0.2;
double throughPanes(int n) {
  return (1.0 - kReflectance) / (1.0 + (n - 1) * kReflectance);
}

TEST_P(Panes, LetThroughWhatAPileOfPlatesDoes) {
  StackOfPanes stack(GetParam(), kCosine);
  stack.acrossZ(-20.0f, 1);
  EXPECT_NEAR(tests::meanRadiance(stack.seen(settingsFor(64))).y, throughPanes(GetParam()), 4e-3);
}

TEST_P(Panes, ReflectTheRest) {
  StackOfPanes stack(GetParam(), kCosine);
  stack.acrossZ(20.0f, 1);
  EXPECT_NEAR(tests::meanRadiance(stack.seen(settingsFor(64))).y, 1.0 - throughPanes(GetParam()), 4e-3);
}

INSTANTIATE_TEST_SUITE_P(All, Panes, testing::Values(1, 2, 4));

TEST(SightLines, SeeThroughAPaneWithoutNoise) {
  StackOfPanes stack(1, 0.9);
  stack.acrossZ(-20.0f, 1);
  stack.scene.environment = tests::uniformSky(Rgb(0.25f));
  // R = 0.04 + 0.96 * 0.1^5. The pane hides the panel behind it by R and shows the sky.
  const double reflectance = 0.04 + 0.96 * 1e-5;
  for (const std::uint64_t seed : {1u, 2u}) {
    const Frame frame = stack.seen(settingsFor(16, seed));
    for (const Rgb& sample : frame.viewDependent.pixels()) {
      EXPECT_NEAR(sample.g, (1.0 - reflectance) + 0.25 * reflectance, 1e-5);
    }
  }
}

TEST(SightLines, SeeInAMirrorWithoutNoise) {
  Scene scene;
  Material mirror;
  mirror.baseColor = glm::vec4(0.9f, 0.9f, 0.9f, 1.0f);
  mirror.metallic = 1.0f;
  mirror.roughness = 0.0f;
  mirror.doubleSided = true;
  scene.materials = {mirror, tests::emitter(Rgb(2.0f))};
  tests::place(scene, tests::quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, 0));
  tests::place(scene, tests::quad({-9, -9, 9}, {18, 0, 0}, {0, 18, 0}, 1));
  const Frame frame = makePathRenderer(scene, settingsFor(1))
                          ->render(tests::lookingAt({0, 0, 4}, {0, 0, 0}, {8, 8}, 0.01), 0);
  for (const Rgb& sample : frame.viewDependent.pixels()) EXPECT_NEAR(sample.g, 1.8f, 1e-3f);
}

TEST(SightLines, SeeBothABlendedSurfaceAndWhatIsBehindIt) {
  Scene scene;
  Material veil = tests::emitter(Rgb(2.0f));
  veil.alphaMode = AlphaMode::kBlend;
  veil.baseColor.a = 0.3f;
  scene.materials = {veil, tests::emitter(Rgb(1.0f))};
  tests::place(scene, tests::quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, 0));
  tests::place(scene, tests::quad({-9, -9, -1}, {18, 0, 0}, {0, 18, 0}, 1));
  const Frame frame = makePathRenderer(scene, settingsFor(1))
                          ->render(tests::lookingAt({0, 0, 4}, {0, 0, 0}, {8, 8}, 0.01), 0);
  // The veil's own light is diffuse, what is seen through it is not.
  for (const Rgb& sample : frame.diffuse.pixels()) EXPECT_NEAR(sample.g, 0.3f * 2.0f, 1e-6f);
  for (const Rgb& sample : frame.viewDependent.pixels()) EXPECT_NEAR(sample.g, 0.7f * 1.0f, 1e-6f);
}

TEST(SightLines, ShowMattSurfacesFromTheSolutionWithoutNoiseOfTheirOwn) {
  StackOfPanes stack(1, 0.9);
  stack.scene.materials.push_back(tests::diffuseMaterial(Rgb(0.5f)));
  stack.acrossZ(-2.0f, 2);
  stack.scene.environment = tests::uniformSky(Rgb(1.0f));
  PathSettings settings = settingsFor(1);
  settings.maxBounces = 4;
  const Camera camera = tests::lookingAt({2.0, 0.0, 4.0}, {0, 0, -2}, {16, 16}, 0.2);
  settings.solution = solveLight(stack.scene, settings, std::span(&camera, 1), nullptr, {});
  const Frame first = makePathRenderer(stack.scene, settings)->render(camera, 0);
  settings.seed = 2;
  const Frame second = makePathRenderer(stack.scene, settings)->render(camera, 7);
  EXPECT_GT(tests::meanRadiance(first).y, 0.4);
  EXPECT_THAT(second.viewDependent.pixels(), testing::ElementsAreArray(first.viewDependent.pixels()));
}

BsdfParameters mixed(float metallic, float transmission, float clearcoat, float roughness) {
  BsdfParameters bsdf;
  bsdf.baseColor = Rgb(0.8f, 0.5f, 0.3f);
  bsdf.metallic = metallic;
  bsdf.transmission = transmission;
  bsdf.clearcoat = clearcoat;
  bsdf.roughness = roughness;
  return bsdf;
}

TEST(DeltaLobes, OfASmoothCoatOnASmoothBaseAreOneUnlessTheirNormalsDiffer) {
  BsdfParameters bsdf = mixed(1.0f, 0.0f, 1.0f, 0.0f);
  const glm::vec3 wo(0.6f, 0.0f, 0.8f);
  const auto [none, both, noCoat] = ScatteringSurface(bsdf, wo).deltaLobes();
  EXPECT_EQ(none.weight, Rgb(0.0f));
  EXPECT_EQ(noCoat.weight, Rgb(0.0f));
  EXPECT_EQ(both.wi, glm::vec3(-0.6f, 0.0f, 0.8f));
  bsdf.clearcoatNormal = {0.6f, 0.0f, 0.8f};  // the coat faces wo
  const auto [still, base, coat] = ScatteringSurface(bsdf, wo).deltaLobes();
  EXPECT_NEAR(glm::dot(coat.wi, wo), 1.0f, 1e-5f);
  EXPECT_NEAR(coat.weight.g, 0.04f, 1e-4f);
  EXPECT_EQ(base.wi, glm::vec3(-0.6f, 0.0f, 0.8f));
}

TEST(DeltaLobes, AndTheRestAreTheWholeSurface) {
  BsdfParameters solid = mixed(0.0f, 1.0f, 0.0f, 0.0f);
  solid.thinWalled = false;
  BsdfParameters fromWithin = solid;
  fromWithin.insideMaterial = true;
  for (const BsdfParameters& bsdf :
       {mixed(0.0f, 0.0f, 0.0f, 0.0f), mixed(1.0f, 0.0f, 0.0f, 0.0f), mixed(0.3f, 0.6f, 0.5f, 0.0f),
        mixed(0.0f, 0.0f, 1.0f, 0.5f), mixed(1.0f, 0.0f, 0.7f, 0.3f), solid, fromWithin,
        mixed(0.5f, 0.0f, 0.0f, 0.6f)}) {
    for (const float cosine : {0.1f, 0.5f, 0.95f}) {
      const ScatteringSurface surface(bsdf, {std::sqrt(1.0f - cosine * cosine), 0.0f, cosine});
      const DeltaLobes lobes = surface.deltaLobes();
      const ScatteringSurface rest = surface.withoutDeltaLobes();
      Rgb parts = rest.albedo().viewDependent;
      for (const DeltaLobe& lobe : lobes) parts += lobe.weight;
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(parts[c], surface.albedo().viewDependent[c], 1e-5f);
        EXPECT_EQ(rest.albedo().diffuse[c], surface.albedo().diffuse[c]);
      }
      // A stratified mean of the rest's samples is the rest's albedo.
      constexpr int kSteps = 32;
      Rgb mean(0.0f);
      for (int i = 0; i < kSteps * kSteps * kSteps; ++i) {
        const glm::ivec3 cell(i % kSteps, i / kSteps % kSteps, i / kSteps / kSteps);
        const glm::vec3 u = (glm::vec3(cell) + 0.5f) / static_cast<float>(kSteps);
        const BsdfSample s = rest.sample(u.x, {u.y, u.z});
        if (!(s.pdf > 0.0f)) continue;
        ASSERT_FALSE(s.delta);
        mean += s.diffuse + s.viewDependent;
      }
      mean /= static_cast<float>(kSteps * kSteps * kSteps);
      const Rgb expected = rest.albedo().diffuse + rest.albedo().viewDependent;
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], expected[c], 0.02f) << bsdf.roughness << " " << cosine;
    }
  }
}

}  // namespace
}  // namespace promenade::render
