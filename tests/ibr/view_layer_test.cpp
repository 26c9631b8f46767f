#include "ibr/view_layer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include "src/core/errors.h"
#include "tests/ibr/analytic_scene.h"

namespace promenade::ibr::tests {
namespace {

constexpr Size kSampledSize{24, 16};

/// A wall with a box in front of its right half; every second sample along x and y is known, and the
/// reflection is as given there. What is not known is 100, so that nobody looks at it unnoticed.
struct Sampled {
  Frame frame;
  Mask known{kSampledSize};
  Mask wanted{kSampledSize, 1};
};

Sampled sampled(const std::function<float(int, int)>& reflection) {
  AnalyticScene scene;
  scene.add(1, rectangle({-9, -9, -4}, {18, 0, 0}, {0, 18, 0}), uniform(Rgb(0.5f)))
      .add(2, rectangle({0, -9, -3}, {9, 0, 0}, {0, 18, 0}), uniform(Rgb(0.5f)));
  Sampled s{scene.render(cameraAt({0, 0, 0}, kSampledSize, 20.0))};
  for (int y = 0; y < kSampledSize.height; ++y) {
    for (int x = 0; x < kSampledSize.width; ++x) {
      const bool isKnown = x % 2 == 0 && y % 2 == 0;
      s.known(x, y) = isKnown ? 1 : 0;
      s.frame.viewDependent(x, y) = Rgb(isKnown ? reflection(x, y) : 100.0f);
    }
  }
  return s;
}

ViewLayer interpolated(const Sampled& s) {
  return interpolateViewLayer(s.frame, s.known, s.wanted, {});
}

TEST(ViewLayer, OfAPlaneIsThatPlane) {
  // Rises by 0.01 a sample: over the five samples of a window by 0.08 of 0.7 or more.
  const auto plane = [](int x, int y) { return 0.2f + 0.01f * static_cast<float>(x + y); };
  const ViewLayer layer = interpolated(sampled(plane));
  // Inside of either surface. (The ridge that keeps the fit from tipping leaves a hundredth of the rise.)
  for (const auto& [x, y] : std::vector<std::pair<int, int>>{{3, 3}, {4, 7}, {7, 4}, {15, 9}, {18, 11}}) {
    EXPECT_NE(layer.found(x, y), 0) << x << ", " << y;
    EXPECT_NEAR(layer.viewDependent(x, y).r, plane(x, y), 0.001f) << x << ", " << y;
  }
}

TEST(ViewLayer, LeavesKnownSamplesAlone) {
  const ViewLayer layer = interpolated(sampled([](int, int) { return 0.3f; }));
  EXPECT_EQ(layer.found(4, 4), 0);
}

TEST(ViewLayer, NeverReachesAcrossAnEdge) {
  // The wall's left half reflects 0.2, the box 0.9: at the edge (x = 12) each keeps its own.
  const ViewLayer layer = interpolated(sampled([](int x, int) { return x < 12 ? 0.2f : 0.9f; }));
  for (int y = 3; y < 13; ++y) {
    for (const int x : {9, 11, 12, 13}) {
      const float own = x < 12 ? 0.2f : 0.9f;
      EXPECT_NEAR(layer.viewDependent(x, y).r, layer.found(x, y) != 0 ? own : 0.0f, 1e-5f);
    }
    // Two columns of known samples are near enough on their own side.
    EXPECT_NE(layer.found(9, y), 0) << y;
    EXPECT_NE(layer.found(13, y), 0) << y;
  }
}

TEST(ViewLayer, IsNotFoundWhereItsSamplesDiffer) {
  // Bars of 0.3 and 0.5: a range of 0.2 at a mean of 0.9.
  const ViewLayer layer = interpolated(sampled([](int x, int) { return x % 4 == 0 ? 0.3f : 0.5f; }));
  EXPECT_EQ(layer.found(5, 5), 0);
  EXPECT_EQ(layer.found(4, 5), 0);
}

TEST(ViewLayer, DoesNotTakeNoiseForStructure) {
  // 0.5 of diffuse light and 0.5 of noisy reflection: a standard deviation of 0.05 is 5% of the whole.
  std::minstd_rand random(1);
  std::normal_distribution<float> normal(0.5f, 0.05f);
  const Sampled s = sampled([&](int, int) { return normal(random); });
  const ViewLayer layer =
      interpolateViewLayer(s.frame, s.known, s.wanted, {.noise = [](ItemId) { return 0.05f; }});
  int found = 0, foundAsStructure = 0, wanted = 0;
  double squares = 0.0;
  const ViewLayer unaware = interpolated(s);
  for (int y = 2; y < kSampledSize.height - 2; ++y) {
    for (int x = 2; x < kSampledSize.width - 2; ++x) {
      if (s.known(x, y) != 0) continue;
      ++wanted;
      foundAsStructure += unaware.found(x, y);
      if (layer.found(x, y) == 0) continue;
      ++found;
      squares += std::pow(layer.viewDependent(x, y).r - 0.5, 2.0);
    }
  }
  EXPECT_GT(found, 0.95 * wanted);
  EXPECT_LT(foundAsStructure, 0.5 * wanted);
  // Cleaner than one traced sample. (The fit weighs the nearest most: of two of them 0.05 / sqrt(2).)
  EXPECT_LT(std::sqrt(squares / found), 0.04);
}

TEST(ViewLayer, StillSeesStructureThatStandsOutOfTheNoise) {
  // 0.3 and 0.7 at a mean of 1: a range of 0.4, where noise of 5% may explain 0.08 + 0.225.
  const Sampled s = sampled([](int x, int) { return x % 4 == 0 ? 0.3f : 0.7f; });
  const ViewLayer layer =
      interpolateViewLayer(s.frame, s.known, s.wanted, {.noise = [](ItemId) { return 0.05f; }});
  EXPECT_EQ(layer.found(5, 5), 0);
}

TEST(ViewLayer, AsksForTheNoiseOfTheItemThatIsSeen) {
  // Bars of 0.3 and 0.5 (range 0.2 at a mean of 0.9) on the wall (item 1) and the box (item 2).
  const Sampled s = sampled([](int x, int) { return x % 4 == 0 ? 0.3f : 0.5f; });
  const ViewLayer layer = interpolateViewLayer(
      s.frame, s.known, s.wanted, {.noise = [](ItemId item) { return item == 2 ? 0.05f : 0.0f; }});
  EXPECT_EQ(layer.found(5, 5), 0);
  EXPECT_NE(layer.found(17, 5), 0);
}

TEST(ViewLayer, IsNotFoundFromFewerThanThreeSamples) {
  Sampled s = sampled([](int, int) { return 0.3f; });
  s.known = Mask(kSampledSize);
  s.known(2, 2) = s.known(4, 4) = 1;
  s.frame.viewDependent(2, 2) = s.frame.viewDependent(4, 4) = Rgb(0.3f);
  EXPECT_EQ(interpolated(s).found(3, 3), 0);
  s.known(4, 2) = 1;
  s.frame.viewDependent(4, 2) = Rgb(0.3f);
  EXPECT_NE(interpolated(s).found(3, 3), 0);
}

TEST(ViewLayer, AnswersOnlyWhatIsWanted) {
  Sampled s = sampled([](int, int) { return 0.3f; });
  s.wanted = Mask(kSampledSize);
  s.wanted(5, 5) = 1;
  const ViewLayer layer = interpolated(s);
  int found = 0;
  for (const auto value : layer.found.pixels()) found += value;
  EXPECT_EQ(found, 1);
}

TEST(ViewLayer, RejectsWhatDoesNotFit) {
  const Sampled s = sampled([](int, int) { return 0.3f; });
  EXPECT_THROW((void)interpolateViewLayer(s.frame, Mask(3, 3), s.wanted, {}), InputError);
  EXPECT_THROW((void)interpolateViewLayer(s.frame, s.known, s.wanted, {.reach = 0}), InputError);
  EXPECT_THROW((void)interpolateViewLayer(s.frame, s.known, s.wanted, {.largestRange = 0.0}), InputError);
}

}  // namespace
}  // namespace promenade::ibr::tests
