#include "aqm/metric.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <limits>
#include <random>
#include <thread>

#include "src/core/errors.h"
#include "tests/aqm/metric_by_definition.h"
#include "tests/aqm/patterns.h"

namespace promenade::aqm {
namespace {

using tests::BlobScene;
using tests::frameOf;
using tests::largest;
using tests::noise;
using tests::plainly;
using tests::velocityOf;

VelocityMap randomVelocity(Size size, double fastest) {
  std::mt19937 random(7);
  return velocityOf(size, [&](int x, int) {
    const double speed = x == 0 ? 0.0 : fastest * static_cast<double>(random()) / 4294967295.0;
    const double angle = static_cast<double>(random());
    return glm::dvec2(std::cos(angle), std::sin(angle)) * speed;
  });
}

struct Case {
  Size size;
  double ppd;
  double fastest;
};

void PrintTo(const Case& testCase, std::ostream* out) {
  *out << testCase.size.width << " x " << testCase.size.height << " at " << testCase.ppd
       << " pixels per degree, up to " << testCase.fastest << " degrees per second";
}

class MetricSizes : public ::testing::TestWithParam<Case> {};

TEST_P(MetricSizes, GiveWhatTheDefinitionGives) {
  const auto [size, ppd, fastest] = GetParam();
  const LuminanceMap test = noise(size, 1, 1.5);
  const LuminanceMap reference = noise(size, 2, 1.0);
  const VelocityMap velocity = fastest > 0.0 ? randomVelocity(size, fastest) : VelocityMap();
  const tests::MetricByDefinition expected(test, reference, velocity, ppd);
  const Result found = compare(test, reference, velocity, plainly(ppd));
  ASSERT_EQ(found.jnd.size(), size);
  ASSERT_EQ(found.pooledJnd.size(), size);
  ASSERT_EQ(found.probability.size(), size);
  EXPECT_GT(largest(found.jnd), 0.1) << "nothing to compare";
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      // Single precision: 1e-5 of the value; where channels cancel, of the responses, which reach some ten
      // units.
      ASSERT_NEAR(found.jnd(x, y), expected.jnd(x, y), 1e-4 * expected.jnd(x, y) + 1e-4) << x << ", " << y;
      const double pooled = expected.pooledJnd(x, y);
      ASSERT_NEAR(found.pooledJnd(x, y), pooled, 1e-4 * pooled + 1e-4) << x << ", " << y;
      ASSERT_NEAR(found.probability(x, y), 1.0 - std::exp(-std::pow(pooled, 3.5)), 1e-3) << x << ", " << y;
    }
  }
}

// Baseband only just (1 pixel per degree), even and odd margins, sizes below and above a vector of 8, powers
// of two and not, images smaller than their own reflection, channel speeds at every level and beyond where
// the CSF underflows.
INSTANTIATE_TEST_SUITE_P(, MetricSizes,
                         ::testing::Values(Case{{1, 7}, 8.0, 5.0}, Case{{9, 1}, 5.0, 5.0},
                                           Case{{2, 2}, 1.0, 0.0}, Case{{3, 5}, 0.3, 2.0},
                                           Case{{13, 9}, 8.0, 0.0}, Case{{13, 9}, 8.0, 10.0},
                                           Case{{9, 13}, 16.0, 60.0}, Case{{17, 4}, 7.0, 120.0},
                                           Case{{33, 12}, 16.1, 12.0}, Case{{12, 33}, 4.0, 25.0}));

// Extended by reflection, one pixel is a uniform frame.
TEST(Metric, TakesASinglePixel) {
  const Result result = compare(LuminanceMap(1, 1, 20.0f), LuminanceMap(1, 1, 30.0f),
                                VelocityMap(1, 1, {3.0f, 4.0f}), Settings{40.0});
  ASSERT_EQ(result.jnd.size(), (Size{1, 1}));
  EXPECT_LT(result.jnd(0, 0), 1e-3);
  EXPECT_LT(result.pooledJnd(0, 0), 1e-3);
  EXPECT_LT(result.probability(0, 0), 1e-6);
}

// The CSF passes no frequency 0: S(0) = 0.
TEST(Metric, SeesNothingInAUniformChangeOfAUniformFrame) {
  const Size size{37, 23};
  const LuminanceMap dim = frameOf(size, [](int, int) { return 20.0; });
  const LuminanceMap bright = frameOf(size, [](int, int) { return 30.0; });
  EXPECT_LT(largest(compare(dim, bright, {}, Settings{30.0}).jnd), 1e-3);
}

TEST(Metric, IsTheSameForAnyNumberOfThreads) {
  const BlobScene scene;
  const Result many = compare(scene.withBlob, scene.plain, scene.velocity, Settings{30.0});
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Result single = compare(scene.withBlob, scene.plain, scene.velocity, Settings{30.0});
  EXPECT_TRUE(std::ranges::equal(many.jnd.pixels(), single.jnd.pixels()));
  EXPECT_TRUE(std::ranges::equal(many.probability.pixels(), single.probability.pixels()));
}

TEST(Metric, CanBeCalledFromSeveralThreadsAtOnce) {
  const BlobScene scene;
  const Result expected = compare(scene.withBlob, scene.plain, scene.velocity, Settings{30.0});
  std::vector<Result> results(4);
  {
    std::vector<std::jthread> threads;
    for (Result& result : results) {
      threads.emplace_back(
          [&] { result = compare(scene.withBlob, scene.plain, scene.velocity, Settings{30.0}); });
    }
  }
  for (const Result& result : results) {
    EXPECT_TRUE(std::ranges::equal(result.jnd.pixels(), expected.jnd.pixels()));
  }
}

// Were the CSF's shape taken at one speed for the whole frame, still pixels in a frame with motion would be
// judged up to a hundred decibels too sensitive.
TEST(Metric, JudgesStillPixelsAsStillHoweverFastOthersMove) {
  const Size size{128, 16};
  const LuminanceMap test = noise(size, 3, 0.10);
  const LuminanceMap reference = noise(size, 3, 0.11);
  const VelocityMap rightMoves =
      velocityOf(size, [](int x, int) { return glm::dvec2(x < 64 ? 0.0 : 50.0, x < 64 ? 0.0 : 20.0); });
  const Result still = compare(test, reference, {}, plainly(8.0));
  const Result mixed = compare(test, reference, rightMoves, plainly(8.0));
  // The only paths from right to left are the low-passed masking (radius 18 in the baseband) and pooling.
  for (int x = 0; x < 64 - 18; ++x) {
    ASSERT_EQ(mixed.jnd(x, 8), still.jnd(x, 8)) << x;
  }
  bool differs = false;
  for (int x = 64; x < 128; ++x) {
    differs = differs || std::abs(mixed.jnd(x, 8) - still.jnd(x, 8)) > 0.1f * still.jnd(x, 8);
  }
  EXPECT_TRUE(differs);
}

TEST(Metric, HidesFineDetailThatRacesOverTheRetina) {
  const Size size{64, 64};
  const LuminanceMap grating = frameOf(
      size, [](int x, int) { return 50.0 * (1.0 + 0.1 * std::cos(2.0 * tests::pi * (x + 0.5) / 4.0)); });
  const LuminanceMap flat = frameOf(size, [](int, int) { return 50.0; });
  const auto movingAt = [&](double speed) {
    const VelocityMap velocity = velocityOf(size, [=](int, int) { return glm::dvec2(speed, 0.0); });
    return largest(compare(grating, flat, velocity, Settings{32.0}).jnd);  // 8 cycles per degree
  };
  // 8 cycles per degree: S is 100 at rest and below 1e-3 at 20 degrees per second on the retina (100 in the
  // image).
  EXPECT_GT(movingAt(0.0), 5.0);
  EXPECT_LT(movingAt(100.0), 0.01);
}

TEST(Metric, StaysFiniteForTheBrightestDarkestAndFastest) {
  const Size size{9, 8};
  const LuminanceMap extreme = frameOf(size, [](int x, int) { return x % 2 == 0 ? 1e-30 : 1e30; });
  const LuminanceMap dark = frameOf(size, [](int x, int y) { return 1e-30 * (1 + x + y); });
  const VelocityMap fast =
      velocityOf(size, [](int x, int y) { return glm::dvec2(1e37 * x, std::pow(4.0, y)); });
  for (const double ppd : {0.01, 30.0, 300.0}) {
    const Result result = compare(extreme, dark, fast, Settings{ppd});
    for (std::size_t i = 0; i < size.area(); ++i) {
      ASSERT_TRUE(std::isfinite(result.jnd.pixels()[i])) << ppd << ", " << i;
      ASSERT_TRUE(std::isfinite(result.pooledJnd.pixels()[i])) << ppd << ", " << i;
      ASSERT_GE(result.probability.pixels()[i], 0.0f);
      ASSERT_LE(result.probability.pixels()[i], 1.0f);
    }
  }
}

// A faint blob in a large uniform frame is what it is in a small one: beside it there is nothing to see, and
// one blob hardly changes the mean.
TEST(Metric, OfFramesOf8KIsThatOfTheirPart) {
  const auto blobAt = [](glm::dvec2 centre) {
    return [=](int x, int y) {
      const double dx = x - centre.x;
      const double dy = y - centre.y;
      return std::abs(dx) < 100.0 && std::abs(dy) < 100.0
                 ? 50.0 * (1.0 + 0.2 * std::exp(-(dx * dx + dy * dy) / 50.0))
                 : 50.0;
    };
  };
  const Size large{7680, 4320};
  const Size small{640, 480};
  // Moved by a multiple of 32 pixels, the coarsest grid's step.
  const Result whole =
      compare(frameOf(large, blobAt({7040.0, 3840.0})), LuminanceMap(large, 50.0f), {}, Settings{40.0});
  const Result part =
      compare(frameOf(small, blobAt({320.0, 256.0})), LuminanceMap(small, 50.0f), {}, Settings{40.0});
  const double seen = static_cast<double>(part.pooledJnd(320, 256));
  EXPECT_GT(seen, 1.0);
  EXPECT_NEAR(whole.pooledJnd(7040, 3840), seen, 0.01 * seen);
  EXPECT_LT(whole.pooledJnd(100, 100), 0.01);
}

std::string messageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

TEST(MetricInput, MustBeOfOneSize) {
  const LuminanceMap small(3, 2, 1.0f);
  const LuminanceMap large(4, 2, 1.0f);
  EXPECT_EQ(messageOf([&] { (void)compare(large, small, {}, {}); }),
            "reference frame: expected 4 x 2 pixels, as the test frame has, found 3 x 2");
  EXPECT_EQ(messageOf([&] { (void)compare(large, large, VelocityMap(2, 4), {}); }),
            "velocity: expected 4 x 2 pixels, as the test frame has, found 2 x 4");
  EXPECT_THAT(messageOf([&] { (void)compare({}, {}, {}, {}); }), ::testing::HasSubstr("at least one pixel"));
}

TEST(MetricInput, NamesThePixelThatIsNotALuminance) {
  const LuminanceMap good(4, 3, 10.0f);
  for (const float bad :
       {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    LuminanceMap map(4, 3, 10.0f);
    map(2, 1) = bad;
    EXPECT_THAT(messageOf([&] { (void)compare(map, good, {}, {}); }),
                ::testing::HasSubstr("test frame: pixel (2, 1): expected a finite luminance above 0"));
    EXPECT_THAT(messageOf([&] { (void)compare(good, map, {}, {}); }),
                ::testing::HasSubstr("reference frame: pixel (2, 1)"));
    // Also where both frames are equally wrong.
    EXPECT_THAT(messageOf([&] { (void)compare(map, map, {}, {}); }), ::testing::HasSubstr("pixel (2, 1)"));
  }
}

TEST(MetricInput, NamesThePixelWhoseVelocityIsNotFinite) {
  const LuminanceMap good(4, 3, 10.0f);
  VelocityMap velocity(4, 3);
  velocity(3, 2).y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(messageOf([&] { (void)compare(good, good, velocity, {}); }),
              ::testing::HasSubstr("velocity: pixel (3, 2): expected finite"));
}

TEST(MetricInput, PixelsPerDegreeMustBePositiveAndSane) {
  const LuminanceMap good(4, 3, 10.0f);
  for (const double bad : {0.0, -40.0, 1e9, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT(messageOf([&] { (void)compare(good, good, {}, Settings{bad}); }),
                ::testing::HasSubstr("pixels per degree: expected above 0 and at most 2000, found"));
  }
}

TEST(PercentVisible, CountsThePixelsAboveThreeQuarters) {
  ProbabilityMap probability(4, 2, 0.0f);
  probability(0, 0) = 0.76f;
  probability(1, 0) = 0.75f;  // not above
  probability(3, 1) = 1.0f;
  EXPECT_EQ(percentVisible(probability, {}), 25.0);
}

TEST(PercentVisible, LeavesOutWhatIsExcludedAboveAndBelowTheLine) {
  ProbabilityMap probability(4, 2, 0.0f);
  probability(0, 0) = 1.0f;
  probability(3, 1) = 1.0f;
  Mask excluded(4, 2, 0);
  excluded(0, 0) = 1;
  excluded(1, 0) = 255;
  excluded(2, 0) = 1;
  EXPECT_EQ(percentVisible(probability, excluded), 20.0);  // 1 of the 5 that are left
}

TEST(PercentVisible, IsZeroIfAllIsExcludedOrThereIsNothing) {
  EXPECT_EQ(percentVisible(ProbabilityMap(3, 1, 1.0f), Mask(3, 1, 1)), 0.0);
  EXPECT_EQ(percentVisible({}, {}), 0.0);
}

TEST(PercentVisible, NeedsAMaskOfTheSameSize) {
  EXPECT_EQ(messageOf([] { (void)percentVisible(ProbabilityMap(3, 1), Mask(1, 3)); }),
            "excluded pixels: expected 3 x 1 pixels, as the probability map has, found 1 x 3");
}

}  // namespace
}  // namespace promenade::aqm
