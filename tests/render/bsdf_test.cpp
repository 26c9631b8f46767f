#include "src/render/bsdf.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <string>
#include <vector>

#include "src/render/sampler.h"
#include "tests/render/scenes.h"

namespace promenade::render {
namespace {

using tests::kPi;

glm::vec3 directionOf(double cosine, double azimuth = 0.3) {
  const double sine = std::sqrt(1.0 - cosine * cosine);
  return glm::normalize(glm::vec3(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine));
}

BsdfSample draw(const BsdfParameters& parameters, const glm::vec3& wo, std::uint32_t i,
                std::uint32_t seed = 0) {
  Sampler sampler({{1, 2}, seed, 3}, i);
  const float choose = sampler.next1D();
  return sampleBsdf(parameters, wo, choose, sampler.next2D());
}

BsdfParameters glass(float roughness, bool inside) {
  BsdfParameters p;
  p.roughness = roughness;
  p.transmission = 1.0f;
  p.thinWalled = false;
  p.insideMaterial = inside;
  return p;
}

TEST(Bsdf, IsLambertianWithoutItsSpecularLayer) {
  BsdfParameters p;
  p.specular = 0.0f;
  p.baseColor = {0.2f, 0.5f, 0.9f};
  const BsdfValue v = evaluateBsdf(p, directionOf(0.4), directionOf(0.7, 2.0));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(v.diffuse[c], p.baseColor[c] / kPi * 0.7, 1e-6);
  EXPECT_NEAR(v.viewDependent.g, 0.0f, 1e-6f);
  EXPECT_NEAR(v.pdf, 0.7 / kPi, 1e-6);
}

TEST(Bsdf, ReflectsLikeAMirrorWhereSmooth) {
  BsdfParameters p;
  p.roughness = 0.0f;
  p.metallic = 1.0f;
  p.baseColor = {1.0f, 0.5f, 0.25f};
  const glm::vec3 wo = directionOf(0.6);
  const BsdfSample s = draw(p, wo, 0);
  ASSERT_TRUE(s.delta);
  EXPECT_NEAR(glm::distance(s.wi, glm::vec3(-wo.x, -wo.y, wo.z)), 0.0f, 1e-6f);
  // Schlick: f0 + (1 - f0) 0.4^5.
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(s.viewDependent[c], p.baseColor[c] + (1.0f - p.baseColor[c]) * 0.01024f, 1e-5f);
  }
  EXPECT_EQ(evaluateBsdf(p, wo, s.wi).pdf, 0.0f) << "a mirror cannot be found by chance";
}

TEST(Bsdf, MirrorsInASmoothCoatAboutTheCoatsOwnNormal) {
  // A coat that is tilted by 0.4 about y mirrors the direction straight above to twice that; it reflects
  // Schlick's 0.04 + 0.96 (1 - cos 0.4)^5 there, and the black base under it nothing.
  BsdfParameters p;
  p.baseColor = Rgb(0.0f);
  p.specular = 0.0f;
  p.clearcoat = 1.0f;
  p.clearcoatNormal = {std::sin(0.4f), 0.0f, std::cos(0.4f)};
  double reflected = 0.0;
  for (std::uint32_t i = 0; i < 256; ++i) {
    const BsdfSample s = draw(p, {0.0f, 0.0f, 1.0f}, i);
    if (!(s.pdf > 0.0f)) continue;
    ASSERT_TRUE(s.delta);
    EXPECT_NEAR(glm::distance(s.wi, glm::vec3(std::sin(0.8f), 0.0f, std::cos(0.8f))), 0.0f, 1e-6f);
    reflected += s.viewDependent.g / 256.0;
  }
  EXPECT_NEAR(reflected, 0.04 + 0.96 * std::pow(1.0 - std::cos(0.4), 5.0), 1e-4);
}

TEST(Bsdf, LosesACoatThatFacesAwayFromTheEye) {
  BsdfParameters p;
  p.roughness = 0.5f;
  const glm::vec3 wo = directionOf(0.3, 0.0);
  const glm::vec3 wi = directionOf(0.6, 1.0);
  const BsdfValue bare = evaluateBsdf(p, wo, wi);
  p.clearcoat = 1.0f;
  p.clearcoatRoughness = 0.3f;
  p.clearcoatNormal = directionOf(0.3, kPi);  // cosine with wo: 0.3 * 0.3 - 0.91 < 0
  const BsdfValue coated = evaluateBsdf(p, wo, wi);
  EXPECT_EQ(coated.viewDependent.g, bare.viewDependent.g);
  EXPECT_EQ(coated.diffuse.g, bare.diffuse.g);
  EXPECT_EQ(coated.pdf, bare.pdf);
}

TEST(Bsdf, RefractsBySnellsLaw) {
  // From air at cos = 0.6, sin = 0.8 into n = 1.5: sin = 0.8 / 1.5. Reflectance: 0.04 + 0.96 * 0.4^5 =
  // 0.04983.
  const BsdfParameters p = glass(0.0f, false);
  const glm::vec3 wo = directionOf(0.6, 0.0);
  double reflected = 0.0;
  double refracted = 0.0;
  for (std::uint32_t i = 0; i < 1024; ++i) {
    const BsdfSample s = draw(p, wo, i);
    ASSERT_TRUE(s.delta);
    if (s.wi.z > 0.0f) {
      reflected += s.viewDependent.g / 1024.0;
    } else {
      EXPECT_NEAR(s.wi.x, -0.8f / 1.5f, 1e-5f);
      EXPECT_NEAR(glm::length(s.wi), 1.0f, 1e-5f);
      refracted += s.viewDependent.g / 1024.0;
    }
  }
  EXPECT_NEAR(reflected, 0.04983, 1e-3);
  EXPECT_NEAR(refracted, 1.0 - 0.04983, 1e-3);
}

TEST(Bsdf, ReflectsTotallyBeyondTheCriticalAngle) {
  // From within n = 1.5 the critical angle's cosine is sqrt(1 - 1 / 1.5^2) = 0.7454.
  for (std::uint32_t i = 0; i < 100; ++i) {
    const BsdfSample s = draw(glass(0.0f, true), directionOf(0.74), i);
    ASSERT_GT(s.wi.z, 0.0f);
    EXPECT_NEAR(s.viewDependent.g, 1.0f, 1e-5f);
  }
  int refracted = 0;
  for (std::uint32_t i = 0; i < 100; ++i)
    refracted += draw(glass(0.0f, true), directionOf(0.76), i).wi.z < 0.0f ? 1 : 0;
  EXPECT_GT(refracted, 20);
}

TEST(Bsdf, IsTheSameThroughGlassBothWays) {
  // In basic radiance a smooth boundary transmits equally both ways along one path of light.
  const glm::vec3 outside = directionOf(0.35, 0.0);
  const BsdfParameters in = glass(0.0f, true);
  const BsdfParameters out = glass(0.0f, false);
  double there = 0.0;
  double back = 0.0;
  glm::vec3 inside(0.0f);
  for (std::uint32_t i = 0; i < 4096; ++i) {
    const BsdfSample s = draw(out, outside, i);
    if (s.wi.z < 0.0f) {
      there += s.viewDependent.g;
      inside = {s.wi.x, s.wi.y, -s.wi.z};
    }
  }
  for (std::uint32_t i = 0; i < 4096; ++i) {
    const BsdfSample s = draw(in, inside, i);
    if (s.wi.z < 0.0f) {
      back += s.viewDependent.g;
      EXPECT_NEAR(s.wi.z, -outside.z, 1e-5f);
    }
  }
  EXPECT_NEAR(back / there, 1.0, 2e-3);
}

TEST(Bsdf, LetsShadowRaysThroughASmoothPaneAsItsSamplesPass) {
  BsdfParameters p;
  p.roughness = 0.0f;
  p.transmission = 0.8f;
  p.clearcoat = 0.5f;
  p.baseColor = {0.9f, 0.5f, 0.1f};
  const glm::vec3 wo = directionOf(0.5);
  Rgb passed(0.0f);
  constexpr int kCount = 1 << 14;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const BsdfSample s = draw(p, wo, i);
    if (s.delta && s.wi.z < 0.0f) {
      EXPECT_NEAR(glm::distance(s.wi, -wo), 0.0f, 1e-6f);
      passed += s.viewDependent / static_cast<float>(kCount);
    }
  }
  const Rgb expected = straightTransmittance(p, 0.5f);
  EXPECT_GT(expected.r, 0.5f);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(passed[c], expected[c], 2e-3f);
  p.roughness = 0.3f;
  EXPECT_EQ(straightTransmittance(p, 0.5f), Rgb(0.0f));
  EXPECT_EQ(straightTransmittance(glass(0.0f, false), 0.5f), Rgb(0.0f));
}

TEST(Bsdf, IsReciprocalWithoutACoat) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 3000; ++i) {
    BsdfParameters p;
    p.baseColor = {unit(random), unit(random), unit(random)};
    p.roughness = static_cast<float>(0.05 + 0.95 * unit(random));
    p.metallic = static_cast<float>(unit(random));
    p.transmission = i % 2 == 0 ? 0.0f : static_cast<float>(unit(random));
    p.specularColor = {1.0f, 0.7f, 0.2f};
    const glm::vec3 a = directionOf(0.02 + 0.98 * unit(random), 7.0 * unit(random));
    const glm::vec3 b = directionOf(0.02 + 0.98 * unit(random), 7.0 * unit(random));
    const BsdfValue there = evaluateBsdf(p, a, b);
    const BsdfValue back = evaluateBsdf(p, b, a);
    for (int c = 0; c < 3; ++c) {
      const double x = (there.diffuse[c] + there.viewDependent[c]) * a.z;
      const double y = (back.diffuse[c] + back.viewDependent[c]) * b.z;
      EXPECT_NEAR(x, y, 1e-3 * (x + y) + 1e-7);
    }
    // Through a thin wall, seen from the other side.
    const auto flip = [](const glm::vec3& w) { return glm::vec3(w.x, w.y, -w.z); };
    const double x = evaluateBsdf(p, a, flip(b)).viewDependent.g * a.z;
    const double y = evaluateBsdf(p, b, flip(a)).viewDependent.g * b.z;
    EXPECT_NEAR(x, y, 1e-3 * (x + y) + 1e-7);
  }
}

TEST(Bsdf, WeighsItsSamplesByValueOverDensity) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  int rough = 0;
  for (std::uint32_t i = 0; i < 5000; ++i) {
    BsdfParameters p;
    p.roughness = unit(random);
    p.metallic = unit(random);
    p.transmission = unit(random);
    p.thinWalled = i % 2 == 0;
    p.insideMaterial = !p.thinWalled && i % 4 == 1;
    p.clearcoat = unit(random);
    p.clearcoatRoughness = unit(random);
    p.clearcoatNormal = directionOf(0.4 + 0.6 * unit(random), 7.0 * unit(random));
    const glm::vec3 wo = directionOf(0.01 + 0.99 * unit(random));
    const BsdfSample s = draw(p, wo, i);
    if (s.pdf <= 0.0f || s.delta) continue;
    ++rough;
    const BsdfValue v = evaluateBsdf(p, wo, s.wi);
    EXPECT_NEAR(v.pdf / s.pdf, 1.0f, 1e-4f);
    EXPECT_NEAR(v.diffuse.g / v.pdf, s.diffuse.g, 1e-4f * (1.0f + s.diffuse.g));
    EXPECT_NEAR(v.viewDependent.g / v.pdf, s.viewDependent.g, 1e-4f * (1.0f + s.viewDependent.g));
  }
  EXPECT_GT(rough, 3000);
}

struct Named {
  std::string name;
  BsdfParameters parameters;
};

std::vector<Named> roughMaterials() {
  std::vector<Named> all;
  for (const float roughness : {0.35f, 0.6f, 1.0f}) {
    const std::string suffix = " of roughness " + std::to_string(roughness);
    BsdfParameters p;
    p.roughness = roughness;
    p.baseColor = {0.8f, 0.5f, 0.3f};
    all.push_back({"plastic" + suffix, p});
    p.metallic = 1.0f;
    all.push_back({"metal" + suffix, p});
    p.clearcoat = 1.0f;
    p.clearcoatRoughness = 0.4f;
    all.push_back({"coated metal" + suffix, p});
    p.clearcoatNormal = directionOf(0.8);
    all.push_back({"metal under a tilted coat" + suffix, p});
    p = BsdfParameters{};
    p.roughness = roughness;
    p.transmission = 0.7f;
    all.push_back({"thin wall" + suffix, p});
    all.push_back({"glass from outside" + suffix, glass(roughness, false)});
    all.push_back({"glass from inside" + suffix, glass(roughness, true)});
  }
  return all;
}

TEST(Bsdf, PutsSamplesWhereItsDensitySays) {
  // Bins of equal solid angle: 12 in z by 12 in azimuth. Pearson's chi-square against the integral of the
  // density over each bin (midpoint rule), bins that expect few samples pooled. The statistic's mean is the
  // number of bins less one, k, its standard deviation sqrt(2 k); scrambled samples scatter less than random
  // ones.
  constexpr int kBins = 12;
  constexpr int kSteps = 24;
  constexpr int kCount = 1 << 15;
  for (const Named& material : roughMaterials()) {
    for (const double cosine : {0.9, 0.3}) {
      const glm::vec3 wo = directionOf(cosine);
      std::vector<double> expected(kBins * kBins, 0.0);
      for (int z = 0; z < kBins * kSteps; ++z) {
        for (int a = 0; a < kBins * kSteps; ++a) {
          const double height = 2.0 * (z + 0.5) / (kBins * kSteps) - 1.0;
          const double azimuth = 2.0 * kPi * (a + 0.5) / (kBins * kSteps);
          expected[static_cast<std::size_t>(z / kSteps * kBins + a / kSteps)] +=
              evaluateBsdf(material.parameters, wo, directionOf(height, azimuth)).pdf;
        }
      }
      const double cell = 4.0 * kPi / (kBins * kBins * kSteps * kSteps);
      double integral = 0.0;
      for (double& e : expected) integral += (e *= cell);
      std::vector<double> found(kBins * kBins, 0.0);
      double scattered = 0.0;
      for (std::uint32_t i = 0; i < kCount; ++i) {
        const BsdfSample s = draw(material.parameters, wo, i);
        if (s.pdf <= 0.0f) continue;
        scattered += 1.0 / kCount;
        const double azimuth = std::atan2(s.wi.y, s.wi.x) + (s.wi.y < 0.0f ? 2.0 * kPi : 0.0);
        const int z = std::min(static_cast<int>((s.wi.z + 1.0) / 2.0 * kBins), kBins - 1);
        const int a = std::min(static_cast<int>(azimuth / (2.0 * kPi) * kBins), kBins - 1);
        found[static_cast<std::size_t>(z * kBins + a)] += 1.0;
      }
      SCOPED_TRACE(material.name + ", cosine " + std::to_string(cosine));
      // What is lacking to 1 are normals that would reflect below the horizon: these samples scatter nothing.
      EXPECT_NEAR(integral, scattered, 5e-3);
      double chi = 0.0;
      int bins = 0;
      double restExpected = 0.0;
      double restFound = 0.0;
      for (std::size_t b = 0; b < expected.size(); ++b) {
        const double e = expected[b] * kCount;
        if (e < 20.0) {
          restExpected += e;
          restFound += found[b];
          continue;
        }
        chi += (found[b] - e) * (found[b] - e) / e;
        ++bins;
      }
      EXPECT_LT(chi, bins + 4.0 * std::sqrt(2.0 * bins));
      EXPECT_NEAR(restFound, restExpected, 5.0 * std::sqrt(restExpected) + 5.0);
    }
  }
}

TEST(Bsdf, KeepsTheSameAlbedoWhetherSampledOrIntegrated) {
  for (const Named& material : roughMaterials()) {
    const glm::vec3 wo = directionOf(0.5);
    constexpr int kSide = 256;
    glm::dvec3 integrated(0.0);
    for (int z = 0; z < kSide; ++z) {
      for (int a = 0; a < kSide; ++a) {
        const glm::vec3 wi = directionOf(2.0 * (z + 0.5) / kSide - 1.0, 2.0 * kPi * (a + 0.5) / kSide);
        const BsdfValue v = evaluateBsdf(material.parameters, wo, wi);
        integrated += glm::dvec3(v.diffuse + v.viewDependent) * (4.0 * kPi / (kSide * kSide));
      }
    }
    constexpr int kCount = 1 << 14;
    glm::dvec3 sampled(0.0);
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const BsdfSample s = draw(material.parameters, wo, i);
      if (s.pdf > 0.0f) sampled += glm::dvec3(s.diffuse + s.viewDependent) / double{kCount};
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sampled[c], integrated[c], 0.01) << material.name;
  }
}

TEST(Bsdf, StatesTheAlbedoOfItsParts) {
  for (const Named& material : roughMaterials()) {
    for (const double cosine : {0.95, 0.5, 0.2}) {
      const glm::vec3 wo = directionOf(cosine);
      constexpr int kCount = 1 << 14;
      glm::dvec3 diffuse(0.0);
      glm::dvec3 viewDependent(0.0);
      for (std::uint32_t i = 0; i < kCount; ++i) {
        const BsdfSample s = draw(material.parameters, wo, i);
        if (s.pdf <= 0.0f) continue;
        diffuse += glm::dvec3(s.diffuse) / double{kCount};
        viewDependent += glm::dvec3(s.viewDependent) / double{kCount};
      }
      const BsdfAlbedo albedo = bsdfAlbedo(material.parameters, static_cast<float>(cosine));
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(albedo.diffuse[c], diffuse[c], 0.01) << material.name << ", cosine " << cosine;
        EXPECT_NEAR(albedo.viewDependent[c], viewDependent[c], 0.02)
            << material.name << ", cosine " << cosine;
      }
    }
  }
}

TEST(Bsdf, GivesFiniteNonNegativeNumbersForAnyMaterialAndDirection) {
  std::mt19937 random(13);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  const std::array<float, 6> special = {0.0f, 1.0f, 0.019f, 0.021f, 1e-6f, 0.999999f};
  const auto any = [&] { return random() % 3 == 0 ? special[random() % special.size()] : unit(random); };
  for (std::uint32_t i = 0; i < 200000; ++i) {
    BsdfParameters p;
    p.baseColor = {any(), any(), any()};
    p.metallic = any();
    p.roughness = any();
    p.ior = std::array<float, 7>{1.0f, 1.0001f, 1.33f, 1.5f, 2.4f, 5.0f, 0.0f}[random() % 7];
    p.specular = any();
    p.specularColor = {3.0f * any(), any(), any()};
    p.transmission = any();
    p.thinWalled = random() % 2 == 0;
    p.insideMaterial = !p.thinWalled && random() % 2 == 0;
    p.clearcoat = any();
    p.clearcoatRoughness = any();
    p.clearcoatNormal = directionOf(std::max(1e-6f, any()), 7.0 * any());
    const glm::vec3 wo = directionOf(std::max(1e-6f, any()), 7.0 * any());
    const auto fine = [](const Rgb& v) {
      return std::isfinite(v.r + v.g + v.b) && std::min({v.r, v.g, v.b}) >= 0.0f;
    };
    const BsdfSample s = draw(p, wo, i);
    ASSERT_TRUE(fine(s.diffuse) && fine(s.viewDependent) && std::isfinite(s.pdf) && s.pdf >= 0.0f);
    ASSERT_TRUE(s.pdf == 0.0f || std::abs(glm::length(s.wi) - 1.0f) < 1e-3f);
    const BsdfValue v = evaluateBsdf(p, wo, directionOf(2.0f * any() - 1.0f, 7.0 * any()));
    ASSERT_TRUE(fine(v.diffuse) && fine(v.viewDependent) && std::isfinite(v.pdf) && v.pdf >= 0.0f);
  }
}

}  // namespace
}  // namespace promenade::render
