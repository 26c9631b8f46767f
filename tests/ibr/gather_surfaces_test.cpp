// Which samples of the source lie on the target's surface: nothing torn, nothing mixed up.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "ibr/source_lookup.h"
#include "ibr/warp.h"
#include "tests/ibr/analytic_scene.h"
#include "tests/ibr/maps.h"

namespace promenade::ibr::tests {
namespace {

TEST(GatherWarp, LeavesExactlyTheDisocclusionBehindAColumnAsAHole) {
  // Column |x| < 0.5 at 4 m, wall at 8 m, focal length 64 pixels. From x = 0 the wall is hidden for |x| < 1;
  // from x = 1 the column hides -2 < x < 0 of it. So the wall from 0 to 1 appears: target pixels (x - 1) 64 /
  // 8, that is 8 columns left of the centre. All borders lie between samples.
  AnalyticScene scene;
  scene.add(1, rectangle({-90, -90, -8}, {180, 0, 0}, {0, 180, 0}), uniform(Rgb(0.2f)))
      .add(2, rectangle({-0.5, -90, -4}, {1, 0, 0}, {0, 180, 0}), uniform(Rgb(0.9f)));
  const Size size{64, 5};
  const Frame source = scene.render(cameraAt({0, 0, 0}, size, 64.0));
  const Frame truth = scene.render(cameraAt({1, 0, 0}, size, 64.0));
  const Warped warped = gatherWarp(source, truth.visibility, {});
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      // Beyond the source's right border (64 px = 4 m at the wall) nothing was seen: target (4 - 1) 8 = 24
      // right.
      const Validity expected = x >= 24 && x < 32 ? Validity::kOccluded
                                : x >= 32 + 24    ? Validity::kOutside
                                                  : Validity::kValid;
      EXPECT_EQ(warped.validity(x, y), expected) << x << ", " << y;
      // No skin over the depth edge: every sample has the colour of its own surface.
      if (expected == Validity::kValid) {
        EXPECT_NEAR(warped.diffuse(x, y).r, truth.diffuse(x, y).r, 1e-6f);
      }
    }
  }
}

TEST(GatherWarp, NeverAnswersWithAnotherSurface) {
  // Every item has its own uniform radiance; whatever is valid must have exactly that.
  AnalyticScene scene;
  const auto colour = [](ItemId item) { return Rgb(0.1f * static_cast<float>(item)); };
  scene.setBackground(uniform(colour(9)))
      .add(1, rectangle({-3, -1, -4}, {6, 0, 0}, {0, 2.2, 0}), uniform(colour(1)))
      .add(2, rectangle({-3, -1, -4}, {6, 0, 0}, {0, 0, 8}), uniform(colour(2)))
      .add(3, sphere({-0.7, -0.4, -3}, 0.6), uniform(colour(3)))
      .add(4, box({0.4, -1, -3.2}, {1.2, 0.1, -2.6}), uniform(colour(4)))
      // A poster on the wall, 0.1 mm before it.
      .add(5, rectangle({-0.3, 0.2, -3.9999}, {0.5, 0, 0}, {0, 0.6, 0}), uniform(colour(5)));
  // Railings a quarter of a sample wide, one every 0.2 m.
  for (int i = 0; i < 12; ++i) {
    scene.add(6, rectangle({-1.2 + 0.2 * i, -1, -1.5}, {0.0031, 0, 0}, {0, 0.8, 0}), uniform(colour(6)));
  }
  const Size size{151, 111};
  const Frame source = scene.render(cameraAt({0, 0.1, 0}, size, 120.0));
  for (const double step : {0.003, 0.02, 0.2}) {
    const Frame truth = scene.render(turnedCamera({step, 0.1 - step, -step}, step, 0, 0, size, 120.0));
    const Warped warped = gatherWarp(source, truth.visibility, {});
    int valid = 0;
    for (std::size_t i = 0; i < size.area(); ++i) {
      if (warped.validity.pixels()[i] != Validity::kValid) continue;
      ++valid;
      EXPECT_NEAR(warped.diffuse.pixels()[i].g, truth.diffuse.pixels()[i].g, 1e-6f);
    }
    EXPECT_GT(valid, 0.75 * static_cast<double>(size.area())) << step;
  }
}

TEST(GatherWarp, KeepsTheFacesOfOneItemApartAtACrease) {
  // One item: a box whose faces have different radiance, on a floor of the same item (a merged mesh).
  AnalyticScene scene;
  const Texture byFace = [](const glm::dvec3& p) {
    if (p.y < -1.0 + 1e-6) return Rgb(0.1f);
    if (p.y > 0.5 - 1e-6) return Rgb(0.9f);
    return p.z > -2.0 - 1e-6 ? Rgb(0.5f) : Rgb(0.7f);
  };
  scene.add(1, box({-0.7, -1, -3}, {0.6, 0.5, -2}), byFace)
      .add(1, rectangle({-9, -1, -20}, {18, 0, 0}, {0, 0, 19}), byFace);
  const Size size{121, 91};
  const Frame source = scene.render(cameraAt({0.2, 1.003, 0}, size, 80.0));
  const Frame truth = scene.render(cameraAt({0.23, 1.02, 0.01}, size, 80.0));
  const Warped warped = gatherWarp(source, truth.visibility, {});
  int valid = 0;
  for (std::size_t i = 0; i < size.area(); ++i) {
    if (warped.validity.pixels()[i] != Validity::kValid) continue;
    ++valid;
    EXPECT_NEAR(warped.diffuse.pixels()[i].r, truth.diffuse.pixels()[i].r, 1e-6f);
  }
  EXPECT_GT(valid, 0.95 * static_cast<double>(size.area()));
}

/// Of the samples on `item` that the source sees and whose position there is inside it: the share that is
/// valid.
double validShare(const AnalyticScene& scene, const Camera& from, const Camera& to, ItemId item) {
  const Frame source = scene.render(from);
  const Visibility target = scene.visibility(to);
  const Warped warped = gatherWarp(source, target, {1e9});
  int seen = 0;
  int valid = 0;
  for (int y = 0; y < to.size().height; ++y) {
    for (int x = 0; x < to.size().width; ++x) {
      if (target.item(x, y) != item) continue;
      const glm::dvec3 point = to.pointAt({x + 0.5, y + 0.5}, target.depth(x, y));
      if (warped.validity(x, y) == Validity::kOutside || !scene.sees(from.pose().eye, point)) continue;
      ++seen;
      valid += warped.validity(x, y) == Validity::kValid ? 1 : 0;
    }
  }
  EXPECT_GT(seen, 0);
  return static_cast<double>(valid) / seen;
}

TEST(GatherWarp, DoesNotTearCurvedAndTessellatedSurfaces) {
  const Size size{120, 100};
  const Camera from = cameraAt({0, 0, 0}, size, 100.0);
  const Camera to = turnedCamera({0.1, 0.05, -0.1}, 0.02, 0.01, 0, size, 100.0);
  // What is lost is the silhouette (an eighth of its samples have their nearest source sample beyond it) of a
  // disc of 2 pi r^2 samples: with r = 33 a rim of 2 pi 33 of 3400 samples.
  EXPECT_GT(validShare(AnalyticScene().add(1, sphere({0, 0, -3}, 1.0), uniform(Rgb(1))), from, to, 1), 0.975);
  for (const int sides : {8, 12, 16, 48}) {
    const double share =
        validShare(AnalyticScene().add(1, prism({0, -5, -3}, 1.0, 10, sides), uniform(Rgb(1))), from, to, 1);
    EXPECT_GT(share, 0.985) << sides;
  }
}

/// How many valid target samples on a fold of one item, at x = 0, have their nearest source sample on its
/// other side, which is turned by `degrees`.
int answeredAcrossAFold(double degrees, const WarpSettings& settings) {
  const double radians = degrees * std::numbers::pi / 180.0;
  const AnalyticScene scene =
      AnalyticScene()
          .add(1, rectangle({-4, -4, -3}, {4, 0, 0}, {0, 8, 0}), uniform(Rgb(0.2f)))
          .add(1, rectangle({0, -4, -3}, {4 * std::cos(radians), 0, -4 * std::sin(radians)}, {0, 8, 0}),
               uniform(Rgb(0.8f)));
  const Size size{64, 48};
  const Frame source = scene.render(cameraAt({0.02, 0, 0}, size, 60.0));
  // Turned about the line of sight: the fold crosses many samples, at all places in them.
  const Visibility target = scene.visibility(turnedCamera({0.01, 0.01, 0}, 0, 0, 0.3, size, 60.0));
  const Warped warped = gatherWarp(source, target, settings);
  const SourceLookup lookup(source, target, settings);
  int across = 0;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      if (warped.validity(x, y) != Validity::kValid) continue;
      const glm::ivec2 nearest(glm::floor(lookup(x, y).position));
      if (source.visibility.normal(nearest.x, nearest.y) != target.normal(x, y)) ++across;
    }
  }
  return across;
}

TEST(GatherWarp, DoesNotShowTheFaceBesideABevelInstead) {
  EXPECT_GT(answeredAcrossAFold(15.0, {}), 0);  // as the faces of a column of 24 sides
  EXPECT_EQ(answeredAcrossAFold(27.0, {}), 0);
}

TEST(GatherWarp, HoldsItemsThatMirrorToHalfTheCreaseAngle) {
  const WarpSettings mirrors{.viewDependent = [](ItemId item) { return item == 1; }};
  EXPECT_GT(answeredAcrossAFold(8.0, mirrors), 0);
  EXPECT_EQ(answeredAcrossAFold(15.0, mirrors), 0);
  const WarpSettings others{.viewDependent = [](ItemId item) { return item != 1; }};
  EXPECT_EQ(answeredAcrossAFold(15.0, others), answeredAcrossAFold(15.0, {}));
}

TEST(GatherWarp, DoesNotTearSurfacesSeenAtAGrazingAngle) {
  // A floor to the horizon, 1 m below the eye: the farthest rows see it at 1/60 of a radian.
  const AnalyticScene scene =
      AnalyticScene().add(1, rectangle({-500, -1, -500}, {1000, 0, 0}, {0, 0, 1000}), uniform(Rgb(1)));
  const Size size{80, 60};
  EXPECT_EQ(validShare(scene, cameraAt({0, 0, 0}, size, 60.0),
                       turnedCamera({0.03, 0, -0.2}, 0.1, 0, 0, size, 60.0), 1),
            1.0);
  // The same far from the origin, where a float coordinate is rounded to half a millimetre.
  const glm::dvec3 far(5000, 300, -7000);
  const AnalyticScene farScene = AnalyticScene().add(
      1, rectangle(far + glm::dvec3(-500, -1, -500), {1000, 0, 0}, {0, 0, 1000}), uniform(Rgb(1)));
  EXPECT_EQ(validShare(farScene, cameraAt(far, size, 60.0),
                       turnedCamera(far + glm::dvec3(0.03, 0, -0.2), 0.1, 0, 0, size, 60.0), 1),
            1.0);
}

TEST(GatherWarp, IsWaryOfLoneSamplesAtAGrazingAngleWhereItIsAskedTo) {
  // The side of a board, from 4.1 to 4.8 m away and 0.5 m to the right: with a focal length of 60 from pixel
  // 40 + 60 x 0.5 / 4.8 = 46.25 to 47.32, one sample wide, at the cosine 6.5 / 60 = 0.11. A second board
  // shows its side at 0.5 / 1.0: 60 x 1 / 2.4 to 60 x 1 / 1.8 pixels, eight of them, at cosines above 0.38.
  const AnalyticScene scene =
      AnalyticScene()
          .add(1, rectangle({0.5, -2, -4.1}, {0, 0, -0.7}, {0, 4, 0}), uniform(Rgb(1)))
          .add(2, rectangle({-1, -2, -1.8}, {0, 4, 0}, {0, 0, -0.6}), uniform(Rgb(1)));
  const Size size{80, 60};
  const Frame source = scene.render(cameraAt({0.002, 0.01, 0}, size, 60.0));
  const Visibility target = scene.visibility(cameraAt({0, 0, 0}, size, 60.0));
  const auto answered = [&](ItemId item, double grazingCosine) {
    const Warped warped = gatherWarp(source, target, WarpSettings{.grazingCosine = grazingCosine});
    int count = 0;
    for (std::size_t i = 0; i < target.item.pixels().size(); ++i) {
      if (target.item.pixels()[i] == item && warped.validity.pixels()[i] == Validity::kValid) ++count;
    }
    return count;
  };
  EXPECT_GT(answered(1, 0.0), 20);
  EXPECT_EQ(answered(1, 0.2), 0);
  EXPECT_GT(answered(2, 0.0), 200);
  EXPECT_EQ(answered(2, 0.2), answered(2, 0.0));
}

TEST(GatherWarp, MakesAStretchedSurfaceAHoleWithoutCracks) {
  // A wall seen along itself by the source, and from the front by the target: every sample it covers there is
  // stretched.
  const AnalyticScene scene =
      AnalyticScene().add(1, rectangle({-20, -20, -2}, {40, 0, 0}, {0, 40, 0}), stripes(0.01));
  const Size size{40, 30};
  const Camera alongTheWall = turnedCamera({-6, 0, -1.8}, -1.5, 0, 0, size, 30.0);
  const Frame source = scene.render(alongTheWall);
  const Visibility target = scene.visibility(cameraAt({0, 0, 0}, size, 30.0));
  const Warped warped = gatherWarp(source, target, {});
  EXPECT_EQ(count(warped.validity, Validity::kUndersampled) + count(warped.validity, Validity::kOutside),
            size.width * size.height);
  EXPECT_GT(count(warped.validity, Validity::kUndersampled), 300);
  // With no limit the same samples are all valid: nothing tears.
  const Warped unlimited = gatherWarp(source, target, {kUnlimited});
  EXPECT_EQ(count(unlimited.validity, Validity::kValid), count(warped.validity, Validity::kUndersampled));
}

TEST(GatherWarp, DoesNotTakeTheBackOfASheetForItsFront) {
  const AnalyticScene scene =
      AnalyticScene().add(1, rectangle({-5, -5, -2}, {10, 0, 0}, {0, 10, 0}), uniform(Rgb(1)));
  const Size size{11, 11};
  const Frame source = scene.render(turnedCamera({0, 0, -4}, 3.14159265358979, 0, 0, size, 10.0));
  EXPECT_EQ(source.visibility.item(5, 5), 1U);
  const Warped warped = gatherWarp(source, scene.visibility(cameraAt({0, 0, 0}, size, 10.0)), {});
  EXPECT_EQ(count(warped.validity, Validity::kOccluded), 121);
  // Not even where creases count for nothing.
  const Warped uncreased =
      gatherWarp(source, scene.visibility(cameraAt({0, 0, 0}, size, 10.0)), {2.5, 180.0});
  EXPECT_EQ(count(uncreased.validity, Validity::kOccluded), 121);
}

TEST(GatherWarp, TellsParallelFacesOfOneItemApart) {
  // Two shelves of one item, 5 cm apart (a quarter of a sample is 2.5 mm), the upper hiding the lower from
  // the source.
  const AnalyticScene scene =
      AnalyticScene()
          .add(1, rectangle({-1, -1, -2}, {2, 0, 0}, {0, 2, 0}), uniform(Rgb(0.3f)))
          .add(1, rectangle({-9, -9, -2.05}, {18, 0, 0}, {0, 18, 0}), uniform(Rgb(0.8f)));
  const Size size{300, 5};
  const Frame source = scene.render(cameraAt({0, 0, 0}, size, 200.0));
  const Frame truth = scene.render(cameraAt({0.9, 0, 0}, size, 200.0));
  const Warped warped = gatherWarp(source, truth.visibility, {});
  int occluded = 0;
  for (std::size_t i = 0; i < size.area(); ++i) {
    occluded += warped.validity.pixels()[i] == Validity::kOccluded ? 1 : 0;
    if (warped.validity.pixels()[i] != Validity::kValid) continue;
    EXPECT_NEAR(warped.diffuse.pixels()[i].r, truth.diffuse.pixels()[i].r, 1e-6f);
  }
  // From x = 0 the lower shelf appears right of 1.025 m, from x = 0.9 right of 1.0025 m (to the left it is
  // hidden from 0.9 as well): 0.0225 m are 2.2 samples, in 5 rows.
  EXPECT_GE(occluded, 2 * 5);
  EXPECT_LE(occluded, 3 * 5);
}

TEST(GatherWarp, AllowsForTheRoundingOfCoordinatesFarFromTheOrigin) {
  // 5 km away a float coordinate is rounded to half a millimetre: depths are off by as much, where a quarter
  // of a sample is 0.025 mm (10 cm away, 1000 pixels of focal length).
  const glm::dvec3 far(5000.1, 300.2, -7000.3);
  const AnalyticScene scene = AnalyticScene().add(
      1, rectangle(far + glm::dvec3(-1, -1, -0.1), {2, 0, 0}, {0, 2, 0}), uniform(Rgb(1)));
  const Size size{60, 40};
  const auto rounded = [&](Frame frame) {
    int i = 0;
    for (float& depth : frame.visibility.depth.pixels())
      depth += static_cast<float>(i++ * 7 % 5 - 2) * 0.00012f;
    return frame;
  };
  const Frame source = rounded(scene.render(cameraAt(far, size, 1000.0)));
  const Frame target = rounded(scene.render(cameraAt(far + glm::dvec3(0.0003, 0.0002, 0), size, 1000.0)));
  const Warped warped = gatherWarp(source, target.visibility, {});
  EXPECT_EQ(count(warped.validity, Validity::kOccluded), 0);
  EXPECT_GT(count(warped.validity, Validity::kValid), 0.8 * 60 * 40);
}

}  // namespace
}  // namespace promenade::ibr::tests
