#include "src/render/environment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "src/core/display.h"
#include "src/render/sampler.h"
#include "tests/render/scenes.h"

namespace promenade::render {
namespace {

using tests::kPi;

Environment environmentOf(Size size, const std::function<Rgb(int, int)>& texel, double rotation = 0.0) {
  Environment environment;
  environment.radiance = RadianceMap(size);
  environment.rotationRadians = rotation;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) environment.radiance(x, y) = texel(x, y);
  }
  return environment;
}

Environment noise(Size size) {
  std::mt19937 random(42);
  std::exponential_distribution<float> draw(1.0f);
  return environmentOf(size, [&](int, int) { return Rgb(draw(random), draw(random), draw(random)); });
}

/// Integral over the sphere, midpoint rule in polar angle and azimuth.
double integrate(const std::function<double(const glm::vec3&)>& f, int rows = 600) {
  double sum = 0.0;
  const int columns = 2 * rows;
  for (int y = 0; y < rows; ++y) {
    const double theta = kPi * (y + 0.5) / rows;
    for (int x = 0; x < columns; ++x) {
      const double phi = 2.0 * kPi * (x + 0.5) / columns;
      const glm::vec3 d(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
      sum += f(d) * std::sin(theta);
    }
  }
  return sum * 2.0 * kPi * kPi / rows / columns;
}

glm::vec2 pointOf(std::uint32_t i) {
  Sampler sampler({{3, 1}, 4, 1}, i);
  return sampler.next2D();
}

TEST(EnvironmentLight, KnowsTheSampleOfADirection) {
  const EnvironmentLight varied(noise({31, 17}));
  const EnvironmentLight uniform(tests::uniformSky(Rgb(2.0f)));
  for (std::uint32_t i = 0; i < 100; ++i) {
    for (const EnvironmentLight* light : {&varied, &uniform}) {
      const glm::vec3 direction = light->sample(pointOf(i)).direction;
      const EnvironmentSample s = light->toward(direction);
      EXPECT_EQ(s.direction, direction);
      EXPECT_EQ(s.radiance, light->radiance(direction));
      EXPECT_EQ(s.pdf, light->toward(direction).pdf);
    }
  }
}

TEST(EnvironmentLight, LooksTowardMinusZInTheCentreAndUpAtTheTop) {
  // 8 x 4: column 3 and 4 meet at u = 0.5, which is -Z; u = 0.75, between 5 and 6, is +X; row 0 is up.
  const EnvironmentLight light(environmentOf({8, 4}, [](int x, int y) { return Rgb(x, y, 1.0f); }));
  EXPECT_NEAR(light.radiance({0, 0, -1}).x, 3.5f, 1e-5f);
  EXPECT_NEAR(light.radiance({1, 0, 0}).x, 5.5f, 1e-5f);
  EXPECT_NEAR(light.radiance({-1, 0, 0}).x, 1.5f, 1e-5f);
  EXPECT_NEAR(light.radiance({0, 0, 1}).x, 3.5f, 1e-4f);  // between column 7 and 0
  EXPECT_NEAR(light.radiance({1, 0, 0}).y, 1.5f, 1e-5f);
  EXPECT_NEAR(light.radiance({0, 1, 0}).y, 0.0f, 1e-5f);
  EXPECT_NEAR(light.radiance({0, -1, 0}).y, 3.0f, 1e-5f);
}

TEST(EnvironmentLight, TurnsAboutTheVerticalAxisByTheRightHand) {
  // A quarter turn about +Y takes -Z to -X.
  const auto texel = [](int x, int) { return Rgb(static_cast<float>(x)); };
  const EnvironmentLight still(environmentOf({16, 8}, texel));
  const EnvironmentLight turned(environmentOf({16, 8}, texel, kPi / 2.0));
  for (const float a : {0.1f, 1.0f, 2.0f, 4.0f}) {
    const glm::vec3 d(std::sin(a), 0.0f, -std::cos(a));
    const glm::vec3 rotated(d.z, 0.0f, -d.x);  // x cos + z sin, -x sin + z cos with an angle of pi / 2
    EXPECT_NEAR(turned.radiance(rotated).x, still.radiance(d).x, 1e-4f);
  }
  EXPECT_NEAR(turned.radiance({-1, 0, 0}).x, still.radiance({0, 0, -1}).x, 1e-4f);
}

TEST(EnvironmentLight, HasADensityThatIntegratesToOne) {
  for (const Size size : {Size{1, 1}, Size{2, 1}, Size{1, 3}, Size{3, 1}, Size{7, 5}, Size{64, 33}}) {
    const EnvironmentLight light(noise(size));
    const double integral = integrate([&](const glm::vec3& d) { return light.toward(d).pdf; });
    EXPECT_NEAR(integral, 1.0, 2e-3) << size.width << " x " << size.height;
  }
}

TEST(EnvironmentLight, SamplesWithTheDensityAndRadianceItStates) {
  for (const double rotation : {0.0, 2.3}) {
    Environment environment = noise({31, 17});
    environment.rotationRadians = rotation;
    const EnvironmentLight light(environment);
    for (std::uint32_t i = 0; i < 2000; ++i) {
      const EnvironmentSample s = light.sample(pointOf(i));
      ASSERT_NEAR(glm::length(s.direction), 1.0f, 1e-5f);
      if (std::abs(s.direction.y) > 0.999f) continue;  // acos has no digits left at the poles
      EXPECT_NEAR(light.toward(s.direction).pdf / s.pdf, 1.0f, 2e-3f);
      EXPECT_NEAR(light.radiance(s.direction).g, s.radiance.g, 2e-3f * (1.0f + s.radiance.g));
    }
  }
}

TEST(EnvironmentLight, PutsSamplesWhereTheDensityIs) {
  const EnvironmentLight light(noise({9, 6}));
  // The share of samples in each octant against the integral of the density there.
  constexpr int kCount = 1 << 15;
  std::array<double, 8> share{};
  const auto octant = [](const glm::vec3& d) {
    return static_cast<std::size_t>((d.x > 0 ? 1 : 0) + (d.y > 0 ? 2 : 0) + (d.z > 0 ? 4 : 0));
  };
  for (std::uint32_t i = 0; i < kCount; ++i)
    share[octant(light.sample(pointOf(i)).direction)] += 1.0 / kCount;
  for (std::size_t o = 0; o < 8; ++o) {
    const double expected =
        integrate([&](const glm::vec3& d) { return octant(d) == o ? light.toward(d).pdf : 0.0; }, 300);
    EXPECT_NEAR(share[o], expected, 3e-3) << "octant " << o;
  }
}

TEST(EnvironmentLight, EstimatesAnIrradianceKnownInClosedForm) {
  // L = 1 + y / 2 on a floor that faces up: integral of L y over the upper hemisphere = pi + (1 / 2) 2 pi
  // / 3.
  const Size size{256, 128};
  const EnvironmentLight light(environmentOf(size, [&](int, int row) {
    return Rgb(static_cast<float>(1.0 + 0.5 * std::cos(kPi * (row + 0.5) / size.height)));
  }));
  double sum = 0.0;
  constexpr int kCount = 1 << 14;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const EnvironmentSample s = light.sample(pointOf(i));
    if (s.direction.y > 0.0f) sum += s.radiance.g * s.direction.y / s.pdf;
  }
  EXPECT_NEAR(sum / kCount, kPi + kPi / 3.0, 0.005);
}

TEST(EnvironmentLight, FindsASmallSun) {
  // One texel of 256 x 128 at 10^5 over a sky of 0.1. The sun's flux is its radiance times the solid angle of
  // the bilinear tent around it, that of one texel: 10^5 (2 pi / 256) (pi / 128) sin(theta); the sky's 4 pi
  // / 10.
  const Size size{256, 128};
  const EnvironmentLight light(
      environmentOf(size, [](int x, int y) { return x == 40 && y == 30 ? Rgb(1e5f) : Rgb(0.1f); }));
  const double theta = kPi * 30.5 / 128.0;
  const double sun = 1e5 * (2.0 * kPi / 256.0) * (kPi / 128.0) * std::sin(theta);
  double flux = 0.0;
  int hits = 0;
  constexpr int kCount = 512;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const EnvironmentSample s = light.sample(pointOf(i));
    flux += s.radiance.g / s.pdf / kCount;
    hits += s.radiance.g > 1.0f ? 1 : 0;
  }
  EXPECT_NEAR(flux / (sun + 0.4 * kPi), 1.0, 0.01);
  EXPECT_GT(hits, kCount * 95 / 100);
}

TEST(EnvironmentLight, ChoosesOnlyDirectionsThatShineNearThePolesToo) {
  // Two rows, one of them black: between v = 1/4 and 3/4 the light fades, beyond that it is 0 or whole to the
  // pole.
  for (const int bright : {0, 1}) {
    const EnvironmentLight light(
        environmentOf({4, 2}, [&](int, int y) { return Rgb(y == bright ? 1.0f : 0.0f); }));
    int nearPole = 0;
    for (std::uint32_t i = 0; i < 4096; ++i) {
      const EnvironmentSample s = light.sample(pointOf(i));
      ASSERT_GT(s.radiance.g, 0.0f);
      ASSERT_GT(s.pdf, 0.0f);
      nearPole += std::abs(s.direction.y) > 0.7071f ? 1 : 0;
    }
    // Whole brightness over v < 1/4, a ramp of mean 1/2 over the middle half: a half of the samples each.
    EXPECT_NEAR(nearPole, 2048, 30);
  }
}

TEST(EnvironmentLight, SamplesAUniformSkyUniformly) {
  const EnvironmentLight light(environmentOf({1, 1}, [](int, int) { return Rgb(2.0f, 3.0f, 4.0f); }));
  glm::dvec3 mean(0.0);
  for (std::uint32_t i = 0; i < 4096; ++i) {
    const EnvironmentSample s = light.sample(pointOf(i));
    ASSERT_FLOAT_EQ(s.pdf, static_cast<float>(1.0 / (4.0 * kPi)));
    ASSERT_EQ(s.radiance, Rgb(2.0f, 3.0f, 4.0f));
    mean += glm::dvec3(s.direction) / 4096.0;
  }
  EXPECT_LT(glm::length(mean), 1e-2);
  EXPECT_EQ(light.meanRadiance(), Rgb(2.0f, 3.0f, 4.0f));
}

TEST(EnvironmentLight, WeighsRowsBySolidAngleInItsMean) {
  // Two rows: each is half of the sphere.
  const EnvironmentLight light(environmentOf({4, 2}, [](int, int y) { return Rgb(y == 0 ? 1.0f : 3.0f); }));
  EXPECT_NEAR(light.meanRadiance().g, 2.0f, 1e-5f);
}

TEST(EnvironmentLight, HasNothingToSampleInTheDark) {
  for (const Size size : {Size{1, 1}, Size{5, 3}}) {
    const EnvironmentLight light(environmentOf(size, [](int, int) { return Rgb(0.0f); }));
    EXPECT_EQ(light.sample({0.3f, 0.8f}).pdf, 0.0f);
    EXPECT_EQ(light.toward({0, 1, 0}).pdf, 0.0f);
    EXPECT_EQ(light.radiance({0, 1, 0}), Rgb(0.0f));
  }
}

TEST(EnvironmentLight, SurvivesTexelsThatAreNoRadiance) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const EnvironmentLight light(environmentOf({6, 4}, [&](int x, int) {
    return x == 0 ? Rgb(nan) : x == 1 ? Rgb(-1.0f) : x == 2 ? Rgb(inf) : Rgb(1.0f);
  }));
  for (std::uint32_t i = 0; i < 500; ++i) {
    const EnvironmentSample s = light.sample(pointOf(i));
    ASSERT_TRUE(std::isfinite(s.pdf) && s.pdf > 0.0f);
    ASSERT_TRUE(std::isfinite(s.radiance.g) && s.radiance.g >= 0.0f);
  }
}

}  // namespace
}  // namespace promenade::render
