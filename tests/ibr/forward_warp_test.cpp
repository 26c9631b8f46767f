#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ibr/warp.h"
#include "src/core/errors.h"
#include "tests/ibr/analytic_scene.h"
#include "tests/ibr/artefacts.h"
#include "tests/ibr/maps.h"

namespace promenade::ibr::tests {
namespace {

/// A wall, a floor, a ball, a box and a column: every item has its own uniform radiance, a tenth of its
/// number.
AnalyticScene colours() {
  const auto colour = [](ItemId item) { return uniform(Rgb(0.1f * static_cast<float>(item))); };
  AnalyticScene scene;
  scene.setBackground(colour(9))
      .add(1, rectangle({-3, -1, -4}, {6, 0, 0}, {0, 2.2, 0}), colour(1))
      .add(2, rectangle({-3, -1, -4}, {6, 0, 0}, {0, 0, 8}), colour(2))
      .add(3, sphere({-0.7, -0.4, -3}, 0.6), colour(3))
      .add(4, box({0.4, -1, -3.2}, {1.2, -0.2, -2.6}), colour(4))
      .add(5, prism({0.1, -1, -2.5}, 0.1, 2, 24), colour(5));
  return scene;
}

TEST(ForwardWarp, ReturnsTheSourceBitForBitAtTheSameCamera) {
  const AnalyticScene scene = colours();
  for (const Size size : {Size{1, 1}, Size{2, 1}, Size{1, 3}, Size{3, 5}, Size{65, 47}}) {
    const Camera camera = turnedCamera({0.2, 0.3, 0.1}, 0.1, -0.2, 0.05, size, 0.7 * size.height);
    Frame source = scene.render(camera);
    float value = 0.0f;
    for (Rgb& radiance : source.diffuse.pixels()) radiance = Rgb(value += 0.37f);
    const Warped warped = forwardWarp(source, camera, {});
    EXPECT_EQ(count(warped.validity, Validity::kValid), size.width * size.height);
    for (std::size_t i = 0; i < size.area(); ++i) {
      EXPECT_EQ(warped.diffuse.pixels()[i], source.diffuse.pixels()[i]);
      EXPECT_EQ(warped.item.pixels()[i], source.visibility.item.pixels()[i]);
      const float depth = source.visibility.depth.pixels()[i];
      if (std::isfinite(depth)) {
        EXPECT_NEAR(warped.depth.pixels()[i], depth, 1e-4f * depth);
      } else {
        EXPECT_EQ(warped.depth.pixels()[i], depth);
      }
    }
  }
}

TEST(ForwardWarp, FindsTheDepthOfAPlaneExactlyAndCoversItWithoutCracks) {
  // 1/depth is linear across the image of a plane: drawing it adds only rounding.
  const AnalyticScene scene =
      AnalyticScene().add(1, rectangle({-60, -1, -60}, {120, 0, 0}, {0, 0, 120}), waves(1.0));
  const Size size{80, 60};
  // Down at the floor, then closer, turned and rolled: every target sample lies within the source's image.
  const Frame source = scene.render(turnedCamera({0, 0.5, 0}, 0, -1.0, 0, size, 40.0));
  const Frame truth = scene.render(turnedCamera({0.1, 0, -0.3}, 0.1, -1.0, 0.2, size, 80.0));
  const Warped warped = forwardWarp(source, truth.visibility.camera, {kUnlimited});
  const Warped gathered = gatherWarp(source, truth.visibility, {kUnlimited});
  EXPECT_EQ(count(warped.validity, Validity::kValid), size.width * size.height);
  for (std::size_t i = 0; i < size.area(); ++i) {
    const float depth = truth.visibility.depth.pixels()[i];
    EXPECT_NEAR(warped.depth.pixels()[i], depth, 1e-4f * depth);
    EXPECT_NEAR(warped.diffuse.pixels()[i].g, gathered.diffuse.pixels()[i].g, 1e-3f);
    EXPECT_NEAR(warped.footprint.pixels()[i], gathered.footprint.pixels()[i],
                1e-2f * gathered.footprint.pixels()[i]);
  }
}

TEST(ForwardWarp, MakesAStretchedSurfaceAHoleAndNotALattice) {
  const AnalyticScene scene =
      AnalyticScene().add(1, rectangle({-20, -20, -2}, {40, 0, 0}, {0, 40, 0}), uniform(Rgb(0.5f)));
  const Size size{40, 30};
  const Frame source = scene.render(turnedCamera({-6, 0, -1.8}, -1.5, 0, 0, size, 30.0));
  const Camera target = cameraAt({0, 0, 0}, size, 30.0);
  const Warped warped = forwardWarp(source, target, {});
  const Warped gathered = gatherWarp(source, scene.visibility(target), {});
  EXPECT_EQ(count(warped.validity, Validity::kValid), 0);
  // What the gather calls too coarse is covered here as well: no hole in it, but for a margin of one source
  // sample.
  int covered = 0;
  for (std::size_t i = 0; i < size.area(); ++i) {
    if (gathered.validity.pixels()[i] != Validity::kUndersampled) continue;
    covered += warped.validity.pixels()[i] == Validity::kUndersampled ? 1 : 0;
  }
  EXPECT_GT(covered, 0.95 * count(gathered.validity, Validity::kUndersampled));
}

TEST(ForwardWarp, DrawsNoSkinOverDepthEdgesAndKeepsItemsApart) {
  const AnalyticScene scene = colours();
  const Size size{201, 151};
  const Frame source = scene.render(cameraAt({0, 0.1, 0}, size, 150.0));
  const Frame truth = scene.render(turnedCamera({0.25, 0.2, -0.2}, 0.08, 0, 0, size, 150.0));
  const Warped warped = forwardWarp(source, truth.visibility.camera, {});
  saveForTheEye(paintInvalid(warped), "forward_warp");
  int valid = 0;
  int wrong = 0;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      if (warped.validity(x, y) != Validity::kValid) continue;
      ++valid;
      // Its radiance is that of the item it says it is: never a mix of two.
      const ItemId item = warped.item(x, y);
      EXPECT_NEAR(warped.diffuse(x, y).r, item == kNoItem ? 0.9f : 0.1f * static_cast<float>(item), 1e-6f);
      if (item == truth.visibility.item(x, y)) continue;
      ++wrong;
      // Wrong only at a silhouette, by half a sample: a neighbour of the truth is that item.
      bool found = false;
      for (int j = std::max(0, y - 1); j <= std::min(size.height - 1, y + 1); ++j) {
        for (int i = std::max(0, x - 1); i <= std::min(size.width - 1, x + 1); ++i) {
          found = found || truth.visibility.item(i, j) == item;
        }
      }
      EXPECT_TRUE(found) << x << ", " << y;
    }
  }
  EXPECT_GT(valid, 0.8 * size.width * size.height);
  EXPECT_LT(wrong, 0.01 * size.width * size.height);
}

TEST(ForwardWarp, LeavesTheDisocclusionBehindAColumnOpen) {
  // The scene of the gather's test: exactly columns 24 to 31 become visible.
  AnalyticScene scene;
  scene.add(1, rectangle({-90, -90, -8}, {180, 0, 0}, {0, 180, 0}), uniform(Rgb(0.2f)))
      .add(2, rectangle({-0.5, -90, -4}, {1, 0, 0}, {0, 180, 0}), uniform(Rgb(0.9f)));
  const Size size{64, 5};
  const Warped warped =
      forwardWarp(scene.render(cameraAt({0, 0, 0}, size, 64.0)), cameraAt({1, 0, 0}, size, 64.0), {});
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const Validity expected = x >= 24 && x < 32 ? Validity::kOccluded
                                : x >= 32 + 24 ? Validity::kOccluded  // as far as the forward warp can tell
                                               : Validity::kValid;
      EXPECT_EQ(warped.validity(x, y), expected) << x << ", " << y;
    }
  }
}

TEST(ForwardWarp, KeepsRailsOneSampleWide) {
  // Rails one sample wide at 2 m, before a wall at 4 m; the rails move 3 samples, the wall 1.5.
  AnalyticScene scene;
  scene.add(1, rectangle({-90, -90, -4}, {180, 0, 0}, {0, 180, 0}), uniform(Rgb(0.2f)));
  for (int i = -10; i <= 10; ++i) {
    const double x = 0.2 * i + 0.01;  // the centre of a sample is at 0.01 + 0.02 k
    scene.add(2, rectangle({x - 0.009, -90, -2}, {0.018, 0, 0}, {0, 180, 0}), uniform(Rgb(0.9f)));
  }
  const Size size{100, 3};
  const Warped warped =
      forwardWarp(scene.render(cameraAt({0, 0, 0}, size, 100.0)), cameraAt({0.06, 0, 0}, size, 100.0), {});
  for (int x = 5; x < 90; ++x) {
    // Rails are 10 samples apart, at sample 50 in the source, at 47 in the target.
    if (x % 10 == 7) {
      EXPECT_EQ(warped.item(x, 1), 2U) << x;
      EXPECT_EQ(warped.validity(x, 1), Validity::kValid) << x;
    } else {
      EXPECT_NE(warped.item(x, 1), 2U) << x;
    }
    if (warped.validity(x, 1) == Validity::kValid) {
      EXPECT_NEAR(warped.diffuse(x, 1).r, x % 10 == 7 ? 0.9f : 0.2f, 1e-6f) << x;
    }
  }
}

TEST(ForwardWarp, DrawsTheBackgroundAtInfinity) {
  AnalyticScene scene;
  scene.setBackground(waves(0.4));
  const Size size{61, 41};
  const Frame truth = scene.render(turnedCamera({100, -20, 30}, 0.1, 0.05, 0.1, size, 80.0));
  const Warped warped =
      forwardWarp(scene.render(cameraAt({0, 0, 0}, size, 60.0)), truth.visibility.camera, {});
  const int valid = count(warped.validity, Validity::kValid);
  EXPECT_EQ(valid + count(warped.validity, Validity::kOutside), 61 * 41);
  EXPECT_GT(valid, 0.85 * 61 * 41);
  for (std::size_t i = 0; i < size.area(); ++i) {
    if (warped.validity.pixels()[i] != Validity::kValid) continue;
    EXPECT_EQ(warped.depth.pixels()[i], std::numeric_limits<float>::infinity());
    EXPECT_NEAR(warped.diffuse.pixels()[i].r, truth.diffuse.pixels()[i].r, 0.01f);
  }
}

TEST(ForwardWarp, FindsNothingBehindTheSource) {
  const Size size{17, 13};
  const Warped warped = forwardWarp(colours().render(cameraAt({0, 0, 0}, size, 15.0)),
                                    turnedCamera({0, 0, 0}, 3.14159265, 0, 0, size, 15.0), {});
  EXPECT_EQ(count(warped.validity, Validity::kOutside), 17 * 13);
}

TEST(ForwardWarp, DoesNotDependOnTheNumberOfThreads) {
  const Size size{97, 73};
  const Frame source = colours().render(cameraAt({0, 0, 0}, size, 60.0));
  const Camera target = turnedCamera({0.2, 0.1, -0.1}, 0.1, 0, 0.3, size, 60.0);
  const Warped many = forwardWarp(source, target, {});
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Warped single = forwardWarp(source, target, {});
  EXPECT_TRUE(sameBits(many.depth, single.depth));
  EXPECT_TRUE(sameBits(many.diffuse, single.diffuse));
}

TEST(ForwardWarp, RejectsMapsThatDoNotFit) {
  const Camera camera = cameraAt({0, 0, 0}, {8, 6}, 6.0);
  Frame source = colours().render(camera);
  EXPECT_THROW((void)forwardWarp(source, camera, {-1.0}), InputError);
  source.visibility.normal = NormalMap(Size{8, 5});
  EXPECT_THROW((void)forwardWarp(source, camera, {}), InputError);
}

}  // namespace
}  // namespace promenade::ibr::tests
