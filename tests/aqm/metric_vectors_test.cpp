// Whole comparisons against numbers that two independent double-precision implementations of docs/method.md
// agree on to 1e-14. Tolerance: 1e-3 relative.

#include <gtest/gtest.h>

#include "tests/aqm/patterns.h"

namespace promenade::aqm {
namespace {

using tests::bars;
using tests::BlobScene;
using tests::frameOf;
using tests::largest;
using tests::mean;
using tests::pi;
using tests::plainly;
using tests::velocityOf;

void expectAgreed(double found, double expected) {
  EXPECT_NEAR(found, expected, 1e-3 * expected);
}

LuminanceMap uniform(Size size, double luminance) {
  return frameOf(size, [=](int, int) { return luminance; });
}

constexpr Size kGratingSize{128, 128};
const Settings kGratingSettings = plainly(32.0);

LuminanceMap faintGrating() {
  return frameOf(kGratingSize, [](int x, int) { return 50.0 * (1.0 + 0.01 * bars(x)); });
}

TEST(MetricVectors, AStaticGratingOfTwoCyclesPerDegreeAtOnePerCent) {
  const Result result = compare(faintGrating(), uniform(kGratingSize, 50.0), {}, kGratingSettings);
  expectAgreed(largest(result.jnd), 1.2523);
  expectAgreed(mean(result.jnd), 0.81675);
  expectAgreed(largest(result.pooledJnd), 1.1142);
  expectAgreed(mean(result.probability), 0.68288);
  EXPECT_NEAR(percentVisible(result.probability, {}), 33.37, 0.1);
  expectAgreed(result.jnd(64, 64), 1.2481);
  expectAgreed(result.pooledJnd(64, 64), 1.1142);
  expectAgreed(result.jnd(60, 0), 0.25081);
  expectAgreed(result.pooledJnd(60, 0), 0.92042);
}

TEST(MetricVectors, TheGratingMovingAcrossItsBars) {
  const VelocityMap velocity = velocityOf(kGratingSize, [](int, int) { return glm::dvec2(8.0, 0.0); });
  const Result result = compare(faintGrating(), uniform(kGratingSize, 50.0), velocity, kGratingSettings);
  expectAgreed(largest(result.jnd), 2.1541);
  expectAgreed(mean(result.jnd), 1.4061);
  expectAgreed(largest(result.pooledJnd), 1.9182);
  EXPECT_EQ(percentVisible(result.probability, {}), 100.0);
}

TEST(MetricVectors, TheGratingMovingAlongItsBarsIsLikeAStaticOne) {
  const VelocityMap velocity = velocityOf(kGratingSize, [](int, int) { return glm::dvec2(0.0, 8.0); });
  const Result still = compare(faintGrating(), uniform(kGratingSize, 50.0), {}, kGratingSettings);
  const Result moving = compare(faintGrating(), uniform(kGratingSize, 50.0), velocity, kGratingSettings);
  for (std::size_t i = 0; i < still.jnd.pixels().size(); ++i) {
    // Other orientations see the motion, but of this grating only rounding errors, amplified at most some
    // hundred times.
    ASSERT_NEAR(moving.jnd.pixels()[i], still.jnd.pixels()[i], 1e-4) << "pixel " << i;
  }
}

TEST(MetricVectors, APlaidOnAnImageThatIsNotSquare) {
  const Size size{160, 96};
  const LuminanceMap plaid = frameOf(size, [](int x, int y) {
    return 50.0 * (1.0 + 0.01 * std::cos(2.0 * pi * 12.0 * (x + 0.5) / 160.0) *
                             std::cos(2.0 * pi * 6.0 * (y + 0.5) / 96.0));
  });
  const Result result = compare(plaid, uniform(size, 50.0), {}, plainly(40.0));
  expectAgreed(largest(result.jnd), 1.3347);
  expectAgreed(mean(result.jnd), 0.97511);
  expectAgreed(largest(result.pooledJnd), 1.1879);
  expectAgreed(mean(result.probability), 0.73785);
  EXPECT_NEAR(percentVisible(result.probability, {}), 54.66, 0.1);
  expectAgreed(result.jnd(80, 48), 1.305);
  expectAgreed(result.pooledJnd(0, 0), 0.81178);
}

TEST(MetricVectors, AStrongGratingMasksItsOwnChange) {
  const auto grating = [](double contrast) {
    return frameOf(kGratingSize, [=](int x, int) { return 50.0 * (1.0 + contrast * bars(x)); });
  };
  const Result result = compare(grating(0.36), grating(0.30), {}, kGratingSettings);
  expectAgreed(largest(result.jnd), 0.76038);
  expectAgreed(mean(result.jnd), 0.50227);
  expectAgreed(largest(result.pooledJnd), 0.64179);
  EXPECT_EQ(percentVisible(result.probability, {}), 0.0);
  expectAgreed(result.jnd(64, 64), 0.59108);
  expectAgreed(result.jnd(67, 20), 0.56034);
  expectAgreed(result.pooledJnd(67, 20), 0.6229);
}

TEST(MetricVectors, ABlobOnATextureThatMovesAtEverySpeed) {
  const BlobScene scene;
  const Result moving = compare(scene.withBlob, scene.plain, scene.velocity, plainly(30.0));
  expectAgreed(largest(moving.jnd), 1.9969);
  expectAgreed(mean(moving.jnd), 0.058445);
  expectAgreed(largest(moving.pooledJnd), 1.1409);
  expectAgreed(mean(moving.probability), 0.070699);
  EXPECT_NEAR(percentVisible(moving.probability, {}), 0.8504, 0.01);
  expectAgreed(moving.jnd(120, 50), 1.9883);
  expectAgreed(moving.jnd(110, 60), 0.45755);
  expectAgreed(moving.pooledJnd(110, 60), 1.0249);

  const Result still = compare(scene.withBlob, scene.plain, {}, plainly(30.0));
  expectAgreed(largest(still.jnd), 0.85897);
  expectAgreed(largest(still.pooledJnd), 0.48925);
}

TEST(MetricVectors, AGaborAtTheThresholdOfObservers) {
  const Size size{256, 256};
  const double contrast = std::pow(10.0, -2.106484);  // ModelFest stimulus 4
  const LuminanceMap gabor = frameOf(size, [=](int x, int y) {
    const double u = (x - 128.0) / 120.0;
    const double v = (y - 128.0) / 120.0;
    return 30.0 * (1.0 + contrast * std::cos(2.0 * pi * 4.0 * v) * std::exp(-(u * u + v * v) / 0.5));
  });
  const Result result = compare(gabor, uniform(size, 30.0), {}, plainly(120.0));
  expectAgreed(largest(result.jnd), 1.6878);
  expectAgreed(mean(result.jnd), 0.38567);
  expectAgreed(largest(result.pooledJnd), 0.9767);
  expectAgreed(mean(result.probability), 0.28789);
  expectAgreed(result.jnd(128, 158), 1.4976);
  expectAgreed(result.pooledJnd(128, 158), 0.9505);
}

TEST(MetricVectors, SwappingTheFramesChangesNoBitAndEqualFramesGiveZero) {
  const BlobScene scene;
  const Result forth = compare(scene.withBlob, scene.plain, scene.velocity, plainly(30.0));
  const Result back = compare(scene.plain, scene.withBlob, scene.velocity, plainly(30.0));
  EXPECT_TRUE(std::ranges::equal(forth.jnd.pixels(), back.jnd.pixels()));
  EXPECT_TRUE(std::ranges::equal(forth.pooledJnd.pixels(), back.pooledJnd.pixels()));
  EXPECT_TRUE(std::ranges::equal(forth.probability.pixels(), back.probability.pixels()));
  const Result same = compare(scene.plain, scene.plain, scene.velocity, plainly(30.0));
  EXPECT_EQ(largest(same.jnd), 0.0);
  EXPECT_EQ(largest(same.pooledJnd), 0.0);
  EXPECT_EQ(largest(same.probability), 0.0);
}

}  // namespace
}  // namespace promenade::aqm
