#include "src/render/normal_spread.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <vector>

#include "src/render/material_textures.h"
#include "src/render/microfacet.h"
#include "src/render/path_renderer.h"
#include "src/render/surfaces.h"
#include "tests/render/scenes.h"

namespace promenade::render {
namespace {

/// A small triangle at the top of a sphere of radius `radius`, with the sphere's normals.
struct Patch {
  explicit Patch(float radius) {
    point.normal = point.geometricNormal = {0.0f, 1.0f, 0.0f};
    point.edge1 = {0.01f, 0.0f, 0.0f};
    point.edge2 = {0.003f, 0.0f, 0.02f};
    change = {point.edge1 / radius, point.edge2 / radius};
  }
  /// Of the normals within `major` along x and `minor` along z.
  [[nodiscard]] float variance(float major, float minor) const {
    const Footprint footprint{{major, 0.0f, 0.0f}, {0.0f, 0.0f, minor}, Detail::kFull};
    return normalVariance(point.normal, change, alongEdges(point, footprint));
  }

  SurfacePoint point;
  NormalChange change;
};

TEST(FootprintAlongEdges, IsSolvedForTheTrianglesEdges) {
  const Patch patch(1.0f);
  // 0.05 z = 2.5 edge2 - 0.75 edge1.
  const FootprintAlongEdges axes =
      alongEdges(patch.point, {{0.02f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.05f}, Detail::kFull});
  EXPECT_NEAR(axes.major.x, 2.0f, 1e-5f);
  EXPECT_NEAR(axes.major.y, 0.0f, 1e-5f);
  EXPECT_NEAR(axes.minor.x, -0.75f, 1e-5f);
  EXPECT_NEAR(axes.minor.y, 2.5f, 1e-5f);
}

TEST(NormalVariance, OfASphereIsThatOfEvenTurns) {
  // Over a side of length s the normal turns evenly by s / radius: variance (s / radius)^2 / 12.
  EXPECT_NEAR(Patch(2.0f).variance(0.5f, 0.2f), (0.0625f + 0.01f) / 12.0f, 1e-6f);
  EXPECT_EQ(Patch(2.0f).variance(0.0f, 0.0f), 0.0f);
}

TEST(NormalVariance, OfACylinderComesFromTheWayRoundIt) {
  Patch patch(1.0f);
  const auto around = [](const glm::vec3& edge) { return glm::vec3(edge.x, 0.0f, 0.0f); };
  patch.change = {around(patch.point.edge1), around(patch.point.edge2)};
  EXPECT_NEAR(patch.variance(0.3f, 5.0f), 0.09f / 12.0f, 1e-6f);
}

TEST(NormalVariance, IsZeroOnFlatAndOnDegenerateTriangles) {
  Patch flat(1.0f);
  flat.change = {};
  EXPECT_EQ(flat.variance(1.0f, 1.0f), 0.0f);
  Patch line(1.0f);
  line.point.edge2 = 2.0f * line.point.edge1;
  EXPECT_EQ(line.variance(1.0f, 1.0f), 0.0f);
  // Lengths of normals that were not unit before they were interpolated are no turn.
  Patch longer(1.0f);
  longer.change = {{0.0f, 0.3f, 0.0f}, {0.0f, 0.3f, 0.0f}};
  EXPECT_EQ(longer.variance(0.01f, 0.01f), 0.0f);
}

TEST(BroadenedRoughness, AddsVariancesAndHasALimit) {
  EXPECT_FLOAT_EQ(broadenedRoughness(0.3f, 0.0f), 0.3f);
  EXPECT_NEAR(broadenedRoughness(broadenedRoughness(0.2f, 0.01f), 0.02f), broadenedRoughness(0.2f, 0.03f),
              1e-6f);
  EXPECT_FLOAT_EQ(broadenedRoughness(0.2f, 0.18f), broadenedRoughness(0.2f, 1e9f));
  EXPECT_FLOAT_EQ(broadenedRoughness(1.0f, 0.1f), 1.0f);
  for (float roughness = 0.0f; roughness <= 1.0f; roughness += 0.05f) {
    EXPECT_GE(broadenedRoughness(roughness, 0.001f), roughness);
  }
}

/// Density of facets over slopes, in steps of `step`.
std::vector<double> densities(const std::function<double(float, float)>& density, float step) {
  std::vector<double> all;
  for (int y = -20; y <= 20; ++y) {
    for (int x = -20; x <= 20; ++x) {
      all.push_back(density(step * static_cast<float>(x), step * static_cast<float>(y)));
    }
  }
  return all;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference += std::abs(a[i] - b[i]);
    sum += a[i];
  }
  return difference / sum;
}

TEST(BroadenedRoughness, IsNearTheMeanOfTheLobesOfAllNormals) {
  // Normals that turn evenly by `turn` in both directions, as on a sphere.
  constexpr int kNormals = 16;
  for (const float roughness : {0.1f, 0.22f, 0.4f}) {
    const float alpha = roughness * roughness;
    for (const float turn : {0.5f * alpha, alpha, 2.0f * alpha, 4.0f * alpha}) {
      const auto lobe = [](float broad) {
        return [ggx = Ggx(broad * broad)](float x, float y) {
          return double{ggx.distribution(glm::normalize(glm::vec3(x, y, 1.0f)))};
        };
      };
      const auto allNormals = [&](float x, float y) {
        const auto tilt = [turn](int k) { return turn * ((static_cast<float>(k) + 0.5f) / kNormals - 0.5f); };
        double sum = 0.0;
        for (int i = 0; i < kNormals * kNormals; ++i) {
          sum += lobe(roughness)(x - tilt(i % kNormals), y - tilt(i / kNormals));
        }
        return sum / (kNormals * kNormals);
      };
      const float step = 0.075f * std::max(turn, alpha);
      const std::vector<double> mean = densities(allNormals, step);
      const auto farFromMean = [&](float variance) {
        return distance(mean, densities(lobe(broadenedRoughness(roughness, variance)), step));
      };
      const float variance = 2.0f * turn * turn / 12.0f;
      // No other share of the variance is much better, and none at all is much worse.
      EXPECT_LT(farFromMean(variance), 1.1 * farFromMean(0.5f * variance)) << roughness << " " << turn;
      EXPECT_LT(farFromMean(variance), 1.1 * farFromMean(2.0f * variance)) << roughness << " " << turn;
      EXPECT_LT(farFromMean(variance), 0.6 * farFromMean(0.0f)) << roughness << " " << turn;
    }
  }
}

/// A ball of metal under a sky with sharp bars, seen by so many samples a side.
Frame ballUnderBars(int side) {
  Scene scene;
  Material metal;
  metal.baseColor = glm::vec4(1.0f);
  metal.metallic = 1.0f;
  metal.roughness = 0.15f;
  scene.materials.push_back(metal);
  tests::place(scene, tests::sphere(glm::vec3(0.0f), 1.0f, 512, 256, 0));
  Environment sky;
  const Size size{128, 64};
  sky.radiance = RadianceMap(size, Rgb(0.1f));
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; x += 8) sky.radiance(x, y) = Rgb(2.0f);
  }
  scene.environment = std::move(sky);
  PathSettings settings;
  settings.pathsPerSample = 4096 / (side / 12 * side / 12);
  settings.threads = 2;
  // Nothing of the outline is in view.
  return makePathRenderer(scene, settings)
      ->render(tests::lookingAt({0.0, 0.0, 4.0}, {0.0, 0.0, 0.0}, {side, side}, 0.35), 0);
}

TEST(NormalSpread, ASampleOfACurvedMetalIsTheMeanOfItsCell) {
  constexpr int kCells = 12;
  constexpr int kFine = 12;
  const RadianceMap coarse = combinedRadiance(ballUnderBars(kCells));
  const RadianceMap fine = combinedRadiance(ballUnderBars(kCells * kFine));
  double ofSamples = 0.0;
  double ofPoints = 0.0;
  for (int y = 0; y < kCells; ++y) {
    for (int x = 0; x < kCells; ++x) {
      double mean = 0.0;
      double middle = 0.0;
      for (int j = 0; j < kFine; ++j) {
        for (int i = 0; i < kFine; ++i) {
          const double value = fine(x * kFine + i, y * kFine + j).g;
          mean += value / (kFine * kFine);
          const bool isInTheMiddle = std::abs(2 * i + 1 - kFine) < 2 && std::abs(2 * j + 1 - kFine) < 2;
          if (isInTheMiddle) middle += value / 4.0;
        }
      }
      ofSamples += (coarse(x, y).g - mean) * (coarse(x, y).g - mean);
      ofPoints += (middle - mean) * (middle - mean);
    }
  }
  // What a lobe of the metal alone shows at the middle of a cell is its light at a point.
  EXPECT_LT(ofSamples, 0.25 * ofPoints);
}

}  // namespace
}  // namespace promenade::render
