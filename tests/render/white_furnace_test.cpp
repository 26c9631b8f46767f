// A white surface under a uniform white sky must look white, from everywhere: all light comes back, none is
// made.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <iostream>
#include <numbers>

#include "src/render/bsdf.h"
#include "src/render/sampler.h"

namespace promenade::render {
namespace {

struct Albedo {
  double mean = 0.0;
  double standardError = 0.0;
};

/// Radiance towards wo under a sky of 1, in the brightest channel. The standard error is that of the mean of
/// independently scrambled point sets, which is what their stratification leaves.
Albedo furnace(const BsdfParameters& parameters, double cosine) {
  constexpr std::uint32_t kSets = 16;
  constexpr std::uint32_t kPoints = 1024;
  const glm::vec3 wo(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
  std::array<double, kSets> means{};
  for (std::uint32_t set = 0; set < kSets; ++set) {
    Rgb sum(0.0f);
    for (std::uint32_t i = 0; i < kPoints; ++i) {
      Sampler sampler({{0, 0}, set, 1, kPoints}, i);
      const float choose = sampler.next1D();
      const BsdfSample s = sampleBsdf(parameters, wo, choose, sampler.next2D());
      if (s.pdf > 0.0f) sum += s.diffuse + s.viewDependent;
    }
    means[set] = static_cast<double>(std::max({sum.r, sum.g, sum.b})) / kPoints;
  }
  Albedo result;
  for (const double m : means) result.mean += m / kSets;
  double squares = 0.0;
  for (const double m : means) squares += (m - result.mean) * (m - result.mean);
  result.standardError = std::sqrt(squares / (kSets - 1) / kSets);
  return result;
}

void describe(std::ostream& out, const BsdfParameters& p, double cosine, const Albedo& e) {
  out << "roughness " << p.roughness << ", metallic " << p.metallic << ", transmission " << p.transmission
      << (p.thinWalled       ? " (thin)"
          : p.insideMaterial ? " (inside)"
                             : " (outside)")
      << ", clearcoat " << p.clearcoat << " of roughness " << p.clearcoatRoughness << ", cosine " << cosine
      << ": " << e.mean << " +- " << e.standardError;
}

constexpr std::array kRoughnesses = {0.0f, 0.05f, 0.1f, 0.2f, 0.35f, 0.5f, 0.75f, 1.0f};
constexpr std::array kCosines = {1.0, 0.8, 0.5, 0.25, 0.1, 0.03};

TEST(WhiteFurnace, ReturnsAllLightFromEveryWhiteMaterialAtEveryRoughness) {
  for (const float roughness : kRoughnesses) {
    for (const float metallic : {0.0f, 1.0f}) {
      for (const float transmission : {0.0f, 1.0f}) {
        for (const float coatRoughness : {-1.0f, 0.0f, 0.1f, 0.5f}) {
          for (const double cosine : kCosines) {
            BsdfParameters p;
            p.roughness = roughness;
            p.metallic = metallic;
            p.transmission = transmission;
            p.clearcoat = coatRoughness >= 0.0f ? 1.0f : 0.0f;
            p.clearcoatRoughness = std::max(coatRoughness, 0.0f);
            const Albedo e = furnace(p, cosine);
            // 3.5 standard errors: one of two thousand estimates is allowed to be further off.
            const bool near = e.mean > 0.98 - 3.5 * e.standardError;
            const bool notAbove = e.mean < 1.001 + 3.5 * e.standardError;
            if (!near || !notAbove) {
              ADD_FAILURE();
              describe(std::cerr, p, cosine, e);
              std::cerr << '\n';
            }
          }
        }
      }
    }
  }
}

TEST(WhiteFurnace, ReturnsAllLightFromMixedMaterials) {
  for (const float roughness : kRoughnesses) {
    for (const double cosine : kCosines) {
      BsdfParameters p;
      p.roughness = roughness;
      p.metallic = 0.4f;
      p.transmission = 0.5f;
      p.clearcoat = 0.6f;
      p.clearcoatRoughness = 0.3f;
      p.ior = 1.8f;
      p.specular = 0.7f;
      const Albedo e = furnace(p, cosine);
      EXPECT_GT(e.mean, 0.98 - 3.5 * e.standardError) << roughness << " " << cosine;
      EXPECT_LT(e.mean, 1.001 + 3.5 * e.standardError) << roughness << " " << cosine;
    }
  }
}

TEST(WhiteFurnace, ReturnsAllLightFromBothSidesOfGlass) {
  // The boundary's albedo is read from a coarser table, hence the wider limits: 2%, and within two degrees of
  // grazing, where total reflection begins, 5% too dark or 3% too bright. In the mean over directions nothing
  // may be gained.
  for (const float ior : {1.0f, 1.1f, 1.5f, 2.4f}) {
    for (const bool inside : {false, true}) {
      for (const float roughness : kRoughnesses) {
        double flux = 0.0;
        double weights = 0.0;
        for (const double cosine : kCosines) {
          BsdfParameters p;
          p.roughness = roughness;
          p.transmission = 1.0f;
          p.thinWalled = false;
          p.insideMaterial = inside;
          p.ior = ior;
          const Albedo e = furnace(p, cosine);
          flux += e.mean * cosine;
          weights += cosine;
          const double least = cosine < 0.1 ? 0.95 : 0.98;
          const double most = cosine < 0.1 ? 1.03 : 1.02;
          if (e.mean < least - 3.5 * e.standardError || e.mean > most + 3.5 * e.standardError) {
            ADD_FAILURE();
            describe(std::cerr, p, cosine, e);
            std::cerr << ", ior " << ior << '\n';
          }
        }
        EXPECT_LT(flux / weights, 1.003)
            << "roughness " << roughness << ", ior " << ior << (inside ? ", inside" : "");
      }
    }
  }
}

TEST(WhiteFurnace, IsNeverAboveOneForColoredLayers) {
  for (const float roughness : kRoughnesses) {
    for (const double cosine : kCosines) {
      BsdfParameters p;
      p.roughness = roughness;
      p.baseColor = {1.0f, 0.6f, 0.2f};
      p.specularColor = {0.1f, 2.0f, 30.0f};  // the extension clamps its product with f0 to 1
      const Albedo plain = furnace(p, cosine);
      EXPECT_LT(plain.mean, 1.001 + 3.5 * plain.standardError) << roughness << " " << cosine;
      p.transmission = 0.5f;
      p.metallic = 0.5f;
      const Albedo mixed = furnace(p, cosine);
      EXPECT_LT(mixed.mean, 1.001 + 3.5 * mixed.standardError) << roughness << " " << cosine;
    }
  }
}

TEST(WhiteFurnace, ShowsWhatSingleScatteringWouldLose) {
  // Towards the normal of a white metal of alpha = 1, D = 1 / pi and G2 / (4 cosIn) = 1 / (2 (cosIn + 1)):
  // one bounce returns the integral of cosIn / (cosIn + 1) over cosIn, 1 - ln 2, not a third of the light.
  BsdfParameters p;
  p.roughness = 1.0f;
  p.metallic = 1.0f;
  const glm::vec3 normal(0.0f, 0.0f, 1.0f);
  const double whole = furnace(p, 1.0).mean;
  EXPECT_NEAR(whole, 1.0, 0.01);
  // What comes after the first bounce is spread like the light that is missing: here by far the larger part.
  const double firstBounce = 1.0 / (4.0 * std::numbers::pi);
  EXPECT_GT(evaluateBsdf(p, normal, normal).viewDependent.g, 2.0 * firstBounce);
}

}  // namespace
}  // namespace promenade::render
