#include "src/render/sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "src/render/stratified_mean.h"

namespace promenade::render {
namespace {

/// The pair with number `dimension` (from 0) of a path.
glm::vec2 pairOf(const Sampler::Stream& stream, std::uint32_t path, int dimension) {
  Sampler sampler(stream, path);
  glm::vec2 pair = sampler.next2D();
  for (int i = 0; i < dimension; ++i) pair = sampler.next2D();
  return pair;
}

/// Every elementary interval of area 2^-k (2^a columns by 2^(k-a) rows) must hold exactly one of the 2^k
/// points.
void expectStratified(const Sampler::Stream& stream, std::uint32_t firstPath, int k, int dimension) {
  const std::uint32_t count = 1u << k;
  for (int a = 0; a <= k; ++a) {
    const auto columns = static_cast<float>(1u << a);
    const auto rows = static_cast<float>(1u << (k - a));
    std::vector<int> hits(count, 0);
    for (std::uint32_t i = 0; i < count; ++i) {
      const glm::vec2 p = pairOf(stream, firstPath + i, dimension);
      const auto cell =
          static_cast<std::size_t>(std::floor(p.y * rows) * columns + std::floor(p.x * columns));
      ++hits[cell];
    }
    for (const int h : hits) ASSERT_EQ(h, 1) << "k " << k << ", " << columns << " columns";
  }
}

TEST(Sampler, PutsOnePathIntoEveryElementaryInterval) {
  for (const int k : {0, 1, 4, 7, 10}) {
    for (const int dimension : {0, 1, 13}) expectStratified({{17, 3}, 5, 1}, 0, k, dimension);
  }
}

TEST(Sampler, StratifiesEveryAlignedBlockOfPathsForItself) {
  for (const std::uint32_t block : {1u, 2u, 7u}) expectStratified({{2, 900}, 0, 9}, block * 64, 6, 2);
}

TEST(Sampler, StratifiesEveryAlignedBlockOfPixels) {
  // 4 by 4 pixels with 16 paths each: 256 points, one in every elementary interval of area 1/256.
  std::vector<glm::vec2> points;
  for (std::uint32_t y = 8; y < 12; ++y) {
    for (std::uint32_t x = 20; x < 24; ++x) {
      for (std::uint32_t path = 0; path < 16; ++path) points.push_back(pairOf({{x, y}, 7, 3, 16}, path, 5));
    }
  }
  for (int a = 0; a <= 8; ++a) {
    const auto columns = static_cast<float>(1 << a);
    const auto rows = static_cast<float>(1 << (8 - a));
    std::vector<int> hits(256, 0);
    for (const glm::vec2& p : points) {
      ++hits[static_cast<std::size_t>(std::floor(p.y * rows) * columns + std::floor(p.x * columns))];
    }
    for (const int h : hits) ASSERT_EQ(h, 1) << columns << " columns";
  }
}

TEST(Sampler, ContinuesItsSequenceWithTheNextBlock) {
  // 16 paths first, then 16 and 32 more: every block is stratified, and no point comes twice.
  const auto stream = [](std::uint32_t paths, std::uint32_t block) {
    return Sampler::Stream{{5, 9}, 2, 4, paths, block};
  };
  expectStratified(stream(16, 1), 0, 4, 3);
  expectStratified(stream(32, 1), 0, 5, 3);
  std::vector<float> abscissae;
  for (const auto& s : {stream(16, 0), stream(16, 1), stream(32, 1)}) {
    for (std::uint32_t path = 0; path < s.pathsPerPixel; ++path) abscissae.push_back(pairOf(s, path, 0).x);
  }
  std::sort(abscissae.begin(), abscissae.end());
  EXPECT_EQ(std::adjacent_find(abscissae.begin(), abscissae.end()), abscissae.end());
}

TEST(Sampler, StratifiesSingleDimensions) {
  std::vector<int> hits(128, 0);
  for (std::uint32_t path = 0; path < 128; ++path) {
    Sampler sampler({{4, 4}, 0, 0}, path);
    static_cast<void>(sampler.next2D());
    ++hits[static_cast<std::size_t>(sampler.next1D() * 128.0f)];
  }
  for (const int h : hits) EXPECT_EQ(h, 1);
}

TEST(Sampler, StaysBelowOne) {
  for (std::uint32_t path = 0; path < 100000; ++path) {
    Sampler sampler({{0, 0}, 0, 0}, path * 40503u);
    const glm::vec2 p = sampler.next2D();
    ASSERT_GE(p.x, 0.0f);
    ASSERT_LT(p.x, 1.0f);
    ASSERT_GE(p.y, 0.0f);
    ASSERT_LT(p.y, 1.0f);
  }
}

TEST(Sampler, GivesTheSameNumbersForTheSameArguments) {
  Sampler a({{10, 20}, 30, 40}, 50);
  Sampler b({{10, 20}, 30, 40}, 50);
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(a.next1D(), b.next1D());
    EXPECT_EQ(a.next2D(), b.next2D());
  }
}

TEST(Sampler, ConvergesMuchFasterThanRandomNumbers) {
  // The integral of 4 x y over the unit square is 1, its variance as a random variable 16 / 9 - 1 = 7 / 9, so
  // the mean of 256 random points has a standard error of sqrt(7 / 9 / 256) = 0.0551. Scrambled nets come to
  // O(n^-3/2).
  constexpr std::uint32_t kPaths = 256;
  constexpr std::uint32_t kPixels = 400;
  double squares = 0.0;
  double bias = 0.0;
  for (std::uint32_t pixel = 0; pixel < kPixels; ++pixel) {
    double sum = 0.0;
    for (std::uint32_t path = 0; path < kPaths; ++path) {
      const glm::vec2 p = pairOf({{pixel % 20, pixel / 20}, 0, 0}, path, 1);
      sum += 4.0 * p.x * p.y;
    }
    const double error = sum / kPaths - 1.0;
    squares += error * error;
    bias += error;
  }
  const double rmse = std::sqrt(squares / kPixels);
  EXPECT_LT(rmse, 0.0551 / 20.0);
  EXPECT_LT(std::abs(bias / kPixels), 4.0 * rmse / std::sqrt(double{kPixels})) << "unbiased over scramblings";
}

double covariance(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - 0.5) * (b[i] - 0.5);
  return sum / static_cast<double>(a.size());
}

TEST(Sampler, DecorrelatesPixelsFramesSeedsPathsAndDimensions) {
  constexpr std::uint32_t kSide = 160;
  std::vector<float> here, right, below, later, otherSeed, nextDimension, second, nextPath;
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const glm::vec2 p = pairOf({{x, y}, 7, 0}, 0, 0);
      here.push_back(p.x);
      second.push_back(p.y);
      right.push_back(pairOf({{x + 1, y}, 7, 0}, 0, 0).x);
      below.push_back(pairOf({{x, y + 1}, 7, 0}, 0, 0).x);
      later.push_back(pairOf({{x, y}, 8, 0}, 0, 0).x);
      otherSeed.push_back(pairOf({{x, y}, 7, 1}, 0, 0).x);
      nextDimension.push_back(pairOf({{x, y}, 7, 0}, 0, 1).x);
      nextPath.push_back(pairOf({{x, y}, 7, 0}, 2, 0).x);
    }
  }
  // Products of independent uniform numbers about their mean have standard deviation 1 / 12, their average
  // over n pixels 1 / (12 sqrt(n)); paths 0 and 2 of one stream are stratified and so not quite independent.
  const double limit = 4.5 / (12.0 * kSide);
  EXPECT_NEAR(covariance(here, here), 1.0 / 12.0, 0.002);
  EXPECT_LT(std::abs(covariance(here, second)), limit);
  EXPECT_LT(std::abs(covariance(here, right)), limit);
  EXPECT_LT(std::abs(covariance(here, below)), limit);
  EXPECT_LT(std::abs(covariance(here, later)), limit);
  EXPECT_LT(std::abs(covariance(here, otherSeed)), limit);
  EXPECT_LT(std::abs(covariance(here, nextDimension)), limit);
  EXPECT_LT(std::abs(covariance(here, nextPath)), 1.0 / 12.0 * 0.7);
}

/// The mean of u^2 over the first samples of a sequence, or each from a sequence of its own, and its stated
/// standard error.
struct Estimate {
  float mean, error;
};
Estimate estimate(int count, bool stratified, std::uint32_t seed) {
  StratifiedMean values(count);
  float sum = 0.0f;
  for (int i = 0; i < count; ++i) {
    Sampler::Stream stream;
    stream.seed = seed;
    if (!stratified) stream.frame = static_cast<std::uint32_t>(i);
    Sampler sampler(stream, stratified ? static_cast<std::uint32_t>(i) : 0u);
    const float u = sampler.next1D();
    values.add(i, 0.25f * u * u);  // in two parts
    values.add(i, 0.75f * u * u);
    sum += u * u;
  }
  return {sum / static_cast<float>(count), values.standardError(count)};
}

TEST(StratifiedMean, KnowsTheErrorOfIndependentValues) {
  // The variance of u^2 is 1/5 - 1/9 = 4/45. Over many seeds the stated variance is that of the mean.
  double stated = 0.0;
  constexpr int kSeeds = 400, kCount = 64;
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
    const float error = estimate(kCount, false, seed).error;
    stated += static_cast<double>(error) * error / kSeeds;
  }
  EXPECT_NEAR(stated, 4.0 / 45.0 / kCount, 0.1 * 4.0 / 45.0 / kCount);
}

TEST(StratifiedMean, KnowsWhatStratificationSavesAndErrsOnTheSafeSide) {
  constexpr int kSeeds = 100, kCount = 64;
  double stated = 0.0, actual = 0.0;
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
    const Estimate e = estimate(kCount, true, seed);
    stated += static_cast<double>(e.error) * e.error / kSeeds;
    const double off = static_cast<double>(e.mean) - 1.0 / 3.0;
    actual += off * off / kSeeds;
  }
  // Blocks of 8 with one value in each eighth: variance about 1/8^3 of a twelfth of the slope squared.
  EXPECT_LT(stated, 0.2 * 4.0 / 45.0 / kCount);
  EXPECT_GT(stated, actual);
}

TEST(DoubledMean, StatesTheSameHoweverItGrew) {
  const auto value = [](int i) { return static_cast<float>(i * i % 7); };
  DoubledMean atOnce(64), grown(16);
  for (int i = 0; i < 64; ++i) atOnce.add(i, value(i));
  for (int i = 0; i < 64; ++i) {
    if (i == grown.count()) grown.grow();
    grown.add(i, value(i));
  }
  EXPECT_EQ(grown.count(), 64);
  EXPECT_DOUBLE_EQ(grown.squaredError(), atOnce.squaredError());
}

TEST(DoubledMean, StatesTheErrorOfTheMeanOfItsBlocks) {
  // Two samples a block: means 0, 1, .. 7, whose variance is (8^2 - 1) / 12 = 5.25, 6 with n - 1; of the mean
  // of eight an eighth of that.
  DoubledMean values(16);
  for (int i = 0; i < 16; ++i) values.add(i, static_cast<float>(i / 2));
  EXPECT_DOUBLE_EQ(values.squaredError(), 6.0 / 8.0);
}

}  // namespace
}  // namespace promenade::render
