// The light by direction that light records keep, and broad reflections made from it.

#include "src/render/light_field.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

#include "src/core/display.h"
#include "src/render/basis.h"
#include "src/render/irradiance_records.h"
#include "src/render/path_renderer.h"
#include "src/render/reflection_lobe.h"
#include "src/render/scattering_surface.h"
#include "tests/render/scenes.h"

namespace promenade::render {
namespace {

using tests::kUp;

/// Evenly over the hemisphere, on a Fibonacci spiral.
template <class Visit>
void forHemisphere(int count, const Visit& visit) {
  for (int i = 0; i < count; ++i) {
    const float z = (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
    const float phi = 2.3999632f * static_cast<float>(i);
    const float r = std::sqrt(1.0f - z * z);
    visit(glm::vec3(r * std::cos(phi), r * std::sin(phi), z));
  }
}

TEST(LightField, DirectionsShareTheHemisphere) {
  double solidAngle = 0.0;
  double projected = 0.0;
  for (std::size_t i = 0; i < LightField::kCells; ++i) {
    const glm::vec3& d = LightField::directions()[i];
    EXPECT_NEAR(glm::length(d), 1.0f, 1e-5f);
    EXPECT_GT(d.z, 0.0f);
    EXPECT_GT(LightField::solidAngles()[i], 0.0f);
    solidAngle += LightField::solidAngles()[i];
    projected += LightField::solidAngles()[i] * d.z;
  }
  EXPECT_NEAR(solidAngle, 2.0 * tests::kPi, 1e-4);
  EXPECT_NEAR(projected, tests::kPi, 0.02 * tests::kPi);
}

TEST(LightField, SamplesWithTheDensityThatItStates) {
  // The mean of 1 / pdf is the solid angle of the hemisphere, that of z / pdf is pi, and a band of heights
  // gets its share.
  double all = 0.0, projected = 0.0;
  int low = 0;
  constexpr int kSteps = 256;
  for (int i = 0; i < kSteps * kSteps; ++i) {
    const glm::vec2 u((static_cast<float>(i % kSteps) + 0.5f) / kSteps,
                      (static_cast<float>(i / kSteps) + 0.5f) / kSteps);
    const glm::vec3 d = LightField::sample(u);
    all += 1.0 / LightField::pdf(d);
    projected += d.z / LightField::pdf(d);
    if (d.z < 0.04f) ++low;
  }
  constexpr double kCount = kSteps * kSteps;
  EXPECT_NEAR(all / kCount, 2.0 * tests::kPi, 0.01);
  EXPECT_NEAR(projected / kCount, tests::kPi, 0.01);
  EXPECT_NEAR(low / kCount, std::sqrt(0.04), 0.01);  // the integral of 1 / (2 sqrt z)
}

TEST(LightField, KeepsRadianceToHalfAPerCent) {
  LightField field;
  const Rgb radiance(0.3f, 1.0f, 7.9f);
  field.set(17, radiance);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(field.at(17)[i], radiance[i], 0.005f * 7.9f);
  EXPECT_EQ(field.at(16), Rgb(0.0f));
}

TEST(LightField, WeighsItsCellsAsOneByOne) {
  LightField field;
  LightField::Weights weights;
  Rgb expected(0.0f);
  float sum = 0.0f;
  for (std::size_t i = 0; i < LightField::kCells; ++i) {
    const auto n = static_cast<float>(i);
    field.set(i, Rgb(0.01f * n, 3.0f / (n + 1.0f), n * n));
    weights.cell[i] = 1.0f + std::sin(n);
    expected += weights.cell[i] * field.at(i);
    sum += weights.cell[i];
  }
  const Rgb got = field.weighted(weights);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], expected[c], 1e-5f * expected[c]);
  EXPECT_NEAR(weights.sum(), sum, 1e-4f * sum);
}

/// Perceptual roughness, metallic, cosine of the direction the light goes.
class LobeOfManyDirections : public testing::TestWithParam<std::tuple<float, float, float>> {};

TEST_P(LobeOfManyDirections, IsTheScatteringFunctionInEach) {
  BsdfParameters bsdf;
  bsdf.baseColor = Rgb(0.9f, 0.6f, 0.2f);
  std::tie(bsdf.roughness, bsdf.metallic, std::ignore) = GetParam();
  const float cosine = std::get<2>(GetParam());
  const ScatteringSurface surface(bsdf, {std::sqrt(1.0f - cosine * cosine), 0.0f, cosine});
  // A record that faces another way than the shading normal: some of its cells lie below the horizon.
  const Basis shading(glm::normalize(glm::vec3(0.2f, 1.0f, -0.1f)));
  const Basis field(glm::normalize(glm::vec3(-0.2f, 1.0f, 0.3f)));
  const LightField::Weights weights = weigh(surface.reflectionLobe(), shading, field);
  int below = 0;
  for (std::size_t i = 0; i < LightField::kCells; ++i) {
    const glm::vec3 wi = shading.toLocal(field.toWorld(LightField::directions()[i]));
    const float expected = wi.z > 0.0f ? luminance(surface.evaluate(wi).viewDependent) : 0.0f;
    EXPECT_NEAR(weights.cell[i] / LightField::solidAngles()[i], expected, 1e-3f * expected + 1e-6f) << wi.z;
    if (wi.z <= 0.0f) ++below;
  }
  EXPECT_GT(below, 5);
}

INSTANTIATE_TEST_SUITE_P(All, LobeOfManyDirections,
                         testing::Combine(testing::Values(0.3f, 0.5f, 1.0f), testing::Values(0.0f, 1.0f),
                                          testing::Values(0.05f, 0.6f, 1.0f)));

TEST(FieldSums, PathsInACellsMiddleAreThatCells) {
  for (const std::size_t cell : {std::size_t{0}, std::size_t{9}, std::size_t{44}, LightField::kCells - 1}) {
    FieldSums sums;
    for (const glm::vec3& d : LightField::directions()) sums.addPath(d, Rgb(1.0f));
    for (int i = 0; i < 1000; ++i) sums.addPath(LightField::directions()[cell], Rgb(3.0f));
    const LightField field = sums.finish({}, 1.0f);
    EXPECT_NEAR(field.at(cell).r, 3.0f, 0.02f) << cell;
    EXPECT_NEAR(field.at(cell == 0 ? 1 : cell - 1).r, 1.0f, 0.4f)
        << cell;  // held to the mean by a quarter path
  }
}

TEST(FieldSums, UniformLightIsUniformHoweverTheDirectionsLie) {
  FieldSums sums;
  forHemisphere(3000, [&](const glm::vec3& d) { sums.addPath(d, Rgb(2.0f, 4.0f, 8.0f)); });
  const LightField field = sums.finish({}, 2.0f);
  for (std::size_t i = 0; i < LightField::kCells; ++i) {
    EXPECT_NEAR(field.at(i).r, 1.0f, 0.02f);
    EXPECT_NEAR(field.at(i).b, 4.0f, 0.02f);
  }
}

TEST(FieldSums, ALightGivesWhatItGaveAndFromWhereItWas) {
  forHemisphere(40, [](const glm::vec3& d) {
    if (d.z < 0.1f) return;
    FieldSums sums;
    for (int i = 0; i < 4; ++i) sums.addLight(1, d, Rgb(0.5f));  // four samples, half a unit each
    const LightField field = sums.finish({0, 4, 0}, 1.0f);
    float share = 0.0f;
    glm::vec3 from(0.0f);
    for (std::size_t i = 0; i < LightField::kCells; ++i) {
      const glm::vec3& cell = LightField::directions()[i];
      share += field.at(i).r * cell.z * LightField::solidAngles()[i] / static_cast<float>(tests::kPi);
      from += field.at(i).r * LightField::solidAngles()[i] * cell;
    }
    // A cell's middle has another cosine than the light, the more so near the horizon.
    EXPECT_NEAR(share, 0.5f, d.z > 0.3f ? 0.075f : 0.25f) << d.z;
    EXPECT_GT(glm::dot(glm::normalize(from), d), std::cos(0.13f)) << d.z;
  });
}

/// Bright toward +x, in units of the record's luminance.
LightField halfLit(const glm::vec3& normal) {
  LightField field;
  const Basis basis(normal);
  for (std::size_t i = 0; i < LightField::kCells; ++i) {
    field.set(i, Rgb(basis.toWorld(LightField::directions()[i]).x > 0.0f ? 2.0f : 0.0f));
  }
  return field;
}

/// Weights from a function of the direction in world space.
template <class Weight>
auto weightsOf(const Weight& weight) {
  return [weight](const Basis& field) {
    LightField::Weights weights;
    for (std::size_t i = 0; i < LightField::kCells; ++i) {
      weights.cell[i] = weight(field.toWorld(LightField::directions()[i])) * LightField::solidAngles()[i];
    }
    return weights;
  };
}

TEST(IrradianceRecords, SayWhatArrivesFromWhere) {
  IrradianceRecords records;
  records.place({{0, 0, 0}, kUp, 1.0f});
  const auto even = weightsOf([](const glm::vec3&) { return 1.0f; });
  EXPECT_FALSE(records.meanArriving({0, 0, 0}, kUp, even).has_value());
  records.setLight({{Rgb(3.0f), 0.6f * kUp}}, {halfLit(kUp)});
  const auto mean = [&](const auto& weight) {
    return records.meanArriving({0.1f, 0, 0}, kUp, weightsOf(weight))->g;
  };
  EXPECT_NEAR(mean([](const glm::vec3&) { return 1.0f; }), 3.0f, 0.01f);
  EXPECT_NEAR(mean([](const glm::vec3& d) { return std::max(0.0f, d.x); }), 6.0f, 0.01f);
  EXPECT_NEAR(mean([](const glm::vec3& d) { return std::max(0.0f, -d.x); }), 0.0f, 0.01f);
  const auto none = weightsOf([](const glm::vec3&) { return 0.0f; });
  EXPECT_FALSE(records.meanArriving({0, 0, 0}, kUp, none).has_value());
  EXPECT_FALSE(records.meanArriving({5, 0, 0}, kUp, even).has_value());
}

TEST(IrradianceRecords, DirectionsAreTheWorldsWhateverTheRecordFaces) {
  IrradianceRecords records;
  std::vector<LightField> fields;
  for (const float tilt : {-0.3f, 0.0f, 0.3f}) {
    const glm::vec3 normal(std::sin(tilt), std::cos(tilt), 0.0f);
    records.place({{tilt, 0, 0}, normal, 2.0f});
    fields.push_back(halfLit(normal));
  }
  records.setLight(std::vector<SurfaceLight>(3, {Rgb(1.0f), 0.6f * kUp}), fields);
  const auto mean = records.meanArriving(
      {0, 0, 0}, kUp, weightsOf([](const glm::vec3& d) { return std::max(0.0f, d.x - 0.2f); }));
  EXPECT_NEAR(mean->r, 2.0f, 0.05f);
}

/// Mean of the view-dependent layer over the image.
double reflected(const Scene& scene, const Camera& camera, const PathSettings& settings) {
  const Frame frame = makePathRenderer(scene, settings)->render(camera, 0);
  double sum = 0.0;
  for (const Rgb& pixel : frame.viewDependent.pixels()) sum += luminance(pixel);
  return sum / static_cast<double>(frame.viewDependent.pixels().size());
}

/// A rough floor that shows a bright panel, seen from a height: steep or grazing.
class BroadReflection : public testing::TestWithParam<std::tuple<float, float, double>> {};

TEST_P(BroadReflection, OfAPanelIsWhatPathsSay) {
  const auto [metallic, roughness, height] = GetParam();
  Scene scene;
  Material floor;
  floor.baseColor = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f);
  floor.metallic = metallic;
  floor.roughness = roughness;
  floor.doubleSided = true;
  scene.materials = {floor, tests::emitter(Rgb(5.0f))};
  tests::place(scene, tests::quad({-8.0f, 0.0f, 8.0f}, {16.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -16.0f}, 0));
  tests::place(scene, tests::quad({-2.0f, 0.5f, -4.0f}, {4.0f, 0.0f, 0.0f}, {0.0f, 3.0f, 0.0f}, 1));
  scene.environment = tests::uniformSky(Rgb(0.3f));
  const Camera camera = tests::lookingAt({0.0, height, 4.0}, {0.0, 0.0, -1.0}, {64, 48}, 0.4);
  PathSettings settings;
  settings.pathsPerSample = 128;
  settings.maxBounces = 4;
  const double paths = reflected(scene, camera, settings);
  settings.pathsPerSample = 1;
  settings.solution = solveLight(scene, settings, std::span(&camera, 1), nullptr, {});
  // What is left is the width of a cell: most where the roughest mirror that is not traced is seen at a
  // grazing angle.
  EXPECT_NEAR(reflected(scene, camera, settings), paths, (height < 1.0 ? 0.05 : 0.03) * paths);
}

INSTANTIATE_TEST_SUITE_P(All, BroadReflection,
                         testing::Combine(testing::Values(0.0f, 1.0f),
                                          testing::Values(0.3f, 0.4f, 0.7f, 1.0f),
                                          testing::Values(0.6, 2.0, 6.0)));

}  // namespace
}  // namespace promenade::render
