#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "ibr/source_lookup.h"
#include "ibr/warp.h"
#include "src/core/errors.h"
#include "tests/ibr/analytic_scene.h"
#include "tests/ibr/maps.h"

namespace promenade::ibr::tests {
namespace {

/// A wall 4 m ahead, a floor, a ball, a box, a coplanar poster, and background to the sides.
AnalyticScene room() {
  AnalyticScene scene;
  scene.setBackground(waves(0.5))
      .add(1, rectangle({-3, -1, -4}, {6, 0, 0}, {0, 3, 0}), waves(0.8))
      .add(2, rectangle({-3, -1, -4}, {6, 0, 0}, {0, 0, 8}), waves(0.7))
      .add(3, sphere({-0.7, -0.4, -3}, 0.6), waves(0.6))
      .add(4, box({0.4, -1, -3.2}, {1.2, -0.5, -2.6}), waves(0.5));
  return scene;
}

TEST(GatherWarp, ReturnsTheSourceBitForBitAtTheSameCamera) {
  const AnalyticScene scene = room();
  for (const Size size :
       {Size{1, 1}, Size{2, 1}, Size{1, 3}, Size{2, 2}, Size{3, 5}, Size{4, 4}, Size{65, 47}}) {
    const Camera camera = turnedCamera({0.2, 0.3, 0.1}, 0.1, -0.2, 0.05, size, 0.7 * size.height)
                              .withSubpixelOffset({0.2, -0.4});
    Frame source = scene.render(camera);
    // Values that arithmetic would not leave alone.
    source.diffuse(0, 0) = Rgb(-0.0f, std::numeric_limits<float>::denorm_min(), 3e38f);
    source.viewDependent(size.width - 1, size.height - 1) =
        Rgb(1e-38f, 1e20f, std::numeric_limits<float>::infinity());
    const Visibility target = scene.visibility(camera);
    const Warped warped = gatherWarp(source, target, {});
    EXPECT_EQ(count(warped.validity, Validity::kValid), size.width * size.height);
    EXPECT_TRUE(sameBits(warped.diffuse, source.diffuse));
    EXPECT_TRUE(sameBits(warped.viewDependent, source.viewDependent));
    for (const float f : warped.footprint.pixels()) EXPECT_EQ(f, 1.0f);
    EXPECT_EQ(SourceLookup(source, target, {})(size.width - 1, 0).position,
              glm::vec2(static_cast<float>(size.width) - 0.5f, 0.5f));
  }
}

TEST(GatherWarp, ReturnsEdgeOnSurfacesBitForBitAtTheSameCamera) {
  // Normals perpendicular to the ray, and (rounding) a little beyond: a renderer may deliver both.
  const Camera camera = cameraAt({0, 0, 0}, {5, 5}, 5.0);
  Frame source = room().render(camera);
  std::fill(source.visibility.item.pixels().begin(), source.visibility.item.pixels().end(), 7U);
  std::fill(source.visibility.depth.pixels().begin(), source.visibility.depth.pixels().end(), 3.0f);
  for (int x = 0; x < 5; ++x) {
    for (int y = 0; y < 5; ++y) source.visibility.normal(x, y) = glm::vec3(x < 3 ? 1.0f : -1.0f, 0.0f, 0.0f);
  }
  const Visibility target{camera, source.visibility.depth.clone(), source.visibility.normal.clone(),
                          source.visibility.item.clone()};
  const Warped warped = gatherWarp(source, target, {});
  EXPECT_EQ(count(warped.validity, Validity::kValid), 25);
  EXPECT_TRUE(sameBits(warped.diffuse, source.diffuse));
}

TEST(GatherWarp, ShiftsAWallByWholeSamplesExactly) {
  AnalyticScene scene;
  scene.add(1, rectangle({-50, -50, -2}, {100, 0, 0}, {0, 100, 0}), stripes(0.13));
  const Size size{24, 9};
  // 0.25 m to the right, 16 pixels of focal length, 2 m away: the wall moves 2 pixels left, so that target
  // sample x is source sample x + 2 and the last 2 columns were never seen.
  const Frame source = scene.render(cameraAt({0, 0, 0}, size, 16.0));
  const Warped warped = gatherWarp(source, scene.visibility(cameraAt({0.25, 0, 0}, size, 16.0)), {});
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      if (x + 2 < size.width) {
        EXPECT_EQ(warped.validity(x, y), Validity::kValid);
        EXPECT_EQ(warped.diffuse(x, y), source.diffuse(x + 2, y));
        EXPECT_EQ(warped.viewDependent(x, y), source.viewDependent(x + 2, y));
        EXPECT_FLOAT_EQ(warped.footprint(x, y), 1.0f);
      } else {
        EXPECT_EQ(warped.validity(x, y), Validity::kOutside);
        EXPECT_EQ(warped.diffuse(x, y), Rgb(0.0f));
      }
    }
  }
}

TEST(GatherWarp, EqualsTheTruthWithinTheErrorOfReconstruction) {
  const AnalyticScene scene = room();
  const Size size{161, 121};
  const Frame source = scene.render(cameraAt({0, 0.2, 0}, size, 120.0));
  const Frame truth = scene.render(turnedCamera({0.11, 0.25, -0.13}, 0.03, -0.02, 0.02, size, 120.0));
  const Warped warped = gatherWarp(source, truth.visibility, {});
  int valid = 0;
  float worst = 0.0f;
  Mask counts(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      if (warped.validity(x, y) != Validity::kValid) continue;
      ++valid;
      counts(x, y) = 1;
      for (int c = 0; c < 3; ++c) {
        worst = std::max(worst, std::abs(warped.diffuse(x, y)[c] - truth.diffuse(x, y)[c]));
        EXPECT_NEAR(warped.viewDependent(x, y)[c], 0.25f * warped.diffuse(x, y)[c], 1e-6f);
      }
    }
  }
  // The steepest texture (0.13 * 2 pi / 23 samples * sqrt(3) a sample where it faces the source, twice that
  // on the slopes here) at an edge, where a single agreeing sample is up to 0.7 samples away: 0.1.
  EXPECT_LT(worst, 0.1f);
  EXPECT_GT(psnr(warped.diffuse, truth.diffuse, counts), 48.0);
  EXPECT_GT(valid, 0.88 * size.width * size.height);
}

TEST(GatherWarp, MeasuresTheFootprintAsAnAreaOnTheSurface) {
  const AnalyticScene scene =
      AnalyticScene().add(1, rectangle({-50, -50, -4}, {100, 0, 0}, {0, 100, 0}), uniform(Rgb(1)));
  const Size size{21, 15};
  const Frame source = scene.render(cameraAt({0, 0, 0}, size, 20.0));
  // From 4 m to 2.5 m: (4 / 2.5)^2 = 2.56, just above the limit; with a focal length of 19 instead of 20
  // below it.
  const Warped near = gatherWarp(source, scene.visibility(cameraAt({0, 0, -1.5}, size, 20.0)), {});
  EXPECT_EQ(count(near.validity, Validity::kUndersampled), 21 * 15);
  for (const Rgb& radiance : near.diffuse.pixels())
    EXPECT_NEAR(radiance.r, 1.0f, 1e-5f);  // there, if blurred
  for (const float f : near.footprint.pixels()) EXPECT_NEAR(f, 2.56f, 1e-5f);
  const Warped wide = gatherWarp(source, scene.visibility(cameraAt({0, 0, -1.5}, size, 19.0)), {});
  EXPECT_EQ(count(wide.validity, Validity::kValid), 21 * 15);
  for (const float f : wide.footprint.pixels()) EXPECT_NEAR(f, 2.56f * 0.95f * 0.95f, 1e-5f);
  // Against areas measured by the corners of one sample, for cameras that differ in everything.
  const Camera to = turnedCamera({0.8, 0.3, -0.5}, 0.3, 0.1, 0.2, size, 26.0);
  const Visibility target = scene.visibility(to);
  const Warped warped = gatherWarp(source, target, {kUnlimited});
  const auto areaOnWall = [](const Camera& camera, glm::dvec2 at) {
    const auto onWall = [&](glm::dvec2 pixel) {
      const glm::dvec3 d = camera.direction(pixel);
      return camera.pose().eye + d * ((-4.0 - camera.pose().eye.z) / d.z);
    };
    const double h = 1e-3;
    const glm::dvec3 u = onWall(at + glm::dvec2(h, 0)) - onWall(at - glm::dvec2(h, 0));
    const glm::dvec3 v = onWall(at + glm::dvec2(0, h)) - onWall(at - glm::dvec2(0, h));
    return glm::length(glm::cross(u, v)) / (4.0 * h * h);
  };
  const SourceLookup lookup(source, target, {kUnlimited});
  int measured = 0;
  for (int y = 0; y < size.height; y += 2) {
    for (int x = 0; x < size.width; x += 2) {
      if (warped.validity(x, y) == Validity::kOutside) {
        EXPECT_EQ(warped.footprint(x, y), kUnlimited);
        continue;
      }
      ++measured;
      const double expected = areaOnWall(source.visibility.camera, glm::dvec2(lookup(x, y).position)) /
                              areaOnWall(to, {x + 0.5, y + 0.5});
      EXPECT_NEAR(warped.footprint(x, y), expected, 1e-4 * expected);
    }
  }
  EXPECT_GT(measured, 20);
}

TEST(GatherWarp, MatchesTheBackgroundByDirection) {
  AnalyticScene scene;
  scene.setBackground(waves(0.4));
  const Size size{81, 61};
  const Frame source = scene.render(cameraAt({0, 0, 0}, size, 60.0));
  // The eye moves 100 m, which a point at infinity does not notice.
  const Camera to = turnedCamera({100, -20, 30}, 0.2, 0.1, 0.1, size, 60.0);
  const Frame truth = scene.render(to);
  const Warped warped = gatherWarp(source, truth.visibility, {});
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const auto position = source.visibility.camera.projectDirection(to.direction({x + 0.5, y + 0.5}));
      ASSERT_TRUE(position);
      const bool inside = position->x > 0 && position->y > 0 && position->x < 81 && position->y < 61;
      EXPECT_EQ(warped.validity(x, y), inside ? Validity::kValid : Validity::kOutside);
      if (inside) {
        EXPECT_NEAR(warped.diffuse(x, y).r, truth.diffuse(x, y).r, 0.01f);
      }
    }
  }
}

TEST(GatherWarp, FindsNothingBehindTheSource) {
  const AnalyticScene scene = room();
  const Size size{17, 13};
  const Frame source = scene.render(cameraAt({0, 0, 0}, size, 15.0));
  const Visibility target = scene.visibility(turnedCamera({0, 0, 0}, 3.14159265, 0, 0, size, 15.0));
  const Warped warped = gatherWarp(source, target, {});
  EXPECT_EQ(count(warped.validity, Validity::kOutside), 17 * 13);
  const SourceLookup lookup(source, target, {});
  for (int x = 0; x < size.width; ++x) EXPECT_TRUE(std::isnan(lookup(x, 6).position.x)) << x;
}

TEST(GatherWarp, UsesOnlyRayTracedSamples) {
  const AnalyticScene scene = room();
  const Size size{32, 24};
  Frame source = scene.render(cameraAt({0, 0, 0}, size, 24.0));
  const Visibility target = scene.visibility(cameraAt({0.01, 0.01, 0}, size, 24.0));
  const Warped all = gatherWarp(source, target, {});
  std::fill(source.source.pixels().begin(), source.source.pixels().end(), SampleSource::kBlended);
  // A poisoned warped sample must not be read.
  for (Rgb& radiance : source.diffuse.pixels()) radiance = Rgb(1e30f);
  for (int y = 8; y < 16; ++y) {
    for (int x = 8; x < 16; ++x) {
      source.source(x, y) = (x + y) % 2 == 0 ? SampleSource::kTracedHole : SampleSource::kTracedItem;
      source.diffuse(x, y) = Rgb(0.5f);
    }
  }
  const Warped some = gatherWarp(source, target, {});
  EXPECT_GT(count(some.validity, Validity::kValid), 40);
  const SourceLookup lookup(source, target, {});
  for (std::size_t i = 0; i < size.area(); ++i) {
    const auto sample = static_cast<int>(i);
    const glm::vec2 p = lookup(sample % size.width, sample / size.width).position;
    const bool traced = p.x >= 8 && p.x < 16 && p.y >= 8 && p.y < 16;
    if (all.validity.pixels()[i] == Validity::kValid) {
      EXPECT_EQ(some.validity.pixels()[i], traced ? Validity::kValid : Validity::kNotTraced);
    }
    if (some.validity.pixels()[i] == Validity::kValid) {
      EXPECT_NEAR(some.diffuse.pixels()[i].r, 0.5f, 1e-6f);
    }
  }
}

TEST(GatherWarp, FetchesOnlyWhatIsWanted) {
  const AnalyticScene scene = room();
  const Size size{33, 25};
  const Frame source = scene.render(cameraAt({0, 0, 0}, size, 24.0));
  const Visibility target = scene.visibility(cameraAt({0.05, 0.01, 0}, size, 24.0));
  Mask wanted(size);
  for (std::size_t i = 0; i < size.area(); i += 3) wanted.pixels()[i] = 1;
  const Warped all = gatherWarp(source, target, {});
  const Warped some = gatherWarp(source, target, wanted, {});
  for (std::size_t i = 0; i < size.area(); ++i) {
    EXPECT_EQ(some.validity.pixels()[i], i % 3 == 0 ? all.validity.pixels()[i] : Validity::kNotWanted);
    EXPECT_EQ(some.diffuse.pixels()[i], i % 3 == 0 ? all.diffuse.pixels()[i] : Rgb(0.0f));
  }
}

TEST(GatherWarp, NeverRingsOrGoesNegative) {
  // Bars of 0.05 and 0.95 across smooth surfaces: the cubic may sharpen, but not beyond its neighbours.
  AnalyticScene scene;
  scene.add(1, rectangle({-3, -3, -2}, {6, 0, 0}, {0, 6, 0}), stripes(0.17));
  const Size size{97, 73};
  const Frame source = scene.render(cameraAt({0, 0, 0}, size, 80.0));
  const Warped warped =
      gatherWarp(source, scene.visibility(turnedCamera({0.013, 0.021, 0.05}, 0, 0, 0.1, size, 80.0)), {});
  for (std::size_t i = 0; i < size.area(); ++i) {
    if (warped.validity.pixels()[i] != Validity::kValid) continue;
    EXPECT_GE(warped.diffuse.pixels()[i].r, 0.05f - 1e-6f);
    EXPECT_LE(warped.diffuse.pixels()[i].r, 0.95f + 1e-6f);
  }
}

TEST(GatherWarp, DoesNotDependOnTheNumberOfThreads) {
  const AnalyticScene scene = room();
  const Size size{65, 49};
  const Frame source = scene.render(cameraAt({0, 0, 0}, size, 50.0));
  const Visibility target = scene.visibility(turnedCamera({0.2, 0.1, -0.1}, 0.1, 0, 0, size, 50.0));
  const Warped many = gatherWarp(source, target, {});
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Warped single = gatherWarp(source, target, {});
  EXPECT_TRUE(sameBits(many.diffuse, single.diffuse));
  EXPECT_TRUE(sameBits(many.validity, single.validity));
  EXPECT_TRUE(sameBits(many.footprint, single.footprint));
}

TEST(GatherWarp, WarpsBetweenResolutions) {
  const AnalyticScene scene = room();
  const Camera camera = cameraAt({0, 0.2, 0}, {40, 30}, 30.0);
  // The source has 3 x 3 samples a pixel of the target: the middle one lies on the pixel's centre.
  const Frame source = scene.render(camera.supersampled(3));
  const Frame truth = scene.render(camera);
  const Warped warped = gatherWarp(source, truth.visibility, {});
  EXPECT_EQ(count(warped.validity, Validity::kValid), 40 * 30);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) {
      EXPECT_NEAR(warped.diffuse(x, y).r, source.diffuse(3 * x + 1, 3 * y + 1).r, 1e-4f);
      EXPECT_NEAR(warped.footprint(x, y), 1.0f / 9.0f, 1e-5f);
    }
  }
}

TEST(GatherWarp, RejectsMapsThatDoNotFit) {
  const AnalyticScene scene = room();
  const Camera camera = cameraAt({0, 0, 0}, {8, 6}, 6.0);
  const Visibility target = scene.visibility(camera);
  Frame source = scene.render(camera);
  EXPECT_THROW((void)gatherWarp(source, target, {0.0}), InputError);
  EXPECT_THROW((void)gatherWarp(source, target, {std::nan("")}), InputError);
  EXPECT_THROW((void)gatherWarp(source, target, {2.5, 0.0}), InputError);
  EXPECT_THROW((void)gatherWarp(source, target, {2.5, 181.0}), InputError);
  EXPECT_THROW((void)gatherWarp(source, target, Mask(Size{8, 5}), {}), InputError);
  source.viewDependent = RadianceMap(Size{7, 6});
  EXPECT_THROW((void)gatherWarp(source, target, {}), InputError);
}

}  // namespace
}  // namespace promenade::ibr::tests
