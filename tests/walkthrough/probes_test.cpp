#include "src/walkthrough/probes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace promenade::walkthrough {
namespace {

constexpr std::uint64_t kSeed = 11;

bool same(const std::vector<Probe>& a, const std::vector<Probe>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Probe& p, const Probe& q) {
    return p.x == q.x && p.y == q.y && p.area == q.area;
  });
}

TEST(ChooseProbes, TakesTheAskedShare) {
  // Tiles of 10x10 samples with 100 * 1% = 1 probe each.
  const auto probes = chooseProbes(ProbeWeights(200, 100, 1.0f), 0.01, kSeed);
  EXPECT_EQ(probes.size(), 200u);
  for (const Probe& probe : probes) EXPECT_FLOAT_EQ(probe.area, 100.0f);
}

TEST(ChooseProbes, LeavesNoTileOut) {
  std::vector<int> counts(20 * 10);
  for (const Probe& probe : chooseProbes(ProbeWeights(200, 100, 1.0f), 0.01, kSeed)) {
    ++counts[static_cast<std::size_t>(probe.y / 10 * 20 + probe.x / 10)];
  }
  EXPECT_THAT(counts, testing::Each(1));
}

TEST(ChooseProbes, LooksAtLessSureSamplesAsMuchMoreOftenAsTheyWeigh) {
  ProbeWeights weights(400, 400, 1.0f);
  for (int y = 0; y < 400; ++y) {
    for (int x = 200; x < 400; ++x) weights(x, y) = 4.0f;
  }
  const auto probes = chooseProbes(weights, 0.01, kSeed);
  const auto right = std::count_if(probes.begin(), probes.end(), [](const Probe& p) { return p.x >= 200; });
  // 1600 probes, 4/5 of them on the right, in 800 tiles of expected 1.6 and 800 of 0.4 each: rounding up or
  // down has a variance of 0.24 a tile, so that the numbers have a standard deviation of sqrt(800 * 0.24)
  // = 14.
  EXPECT_NEAR(static_cast<double>(right), 1280.0, 60.0);
  EXPECT_NEAR(static_cast<double>(probes.size()), 1600.0, 80.0);
  // The areas add up to all samples: 40,000 of each kind, 80,000 in each half.
  double area = 0.0;
  for (const Probe& probe : probes) area += probe.area;
  EXPECT_NEAR(area, 160000.0, 0.05 * 160000.0);
}

TEST(ChooseProbes, NeverTakesSamplesWithoutWeight) {
  ProbeWeights weights(37, 23);
  EXPECT_TRUE(chooseProbes(weights, 0.5, kSeed).empty());
  weights(36, 22) = 0.5f;
  const auto probes = chooseProbes(weights, 1.0, kSeed);
  ASSERT_EQ(probes.size(), 1u);
  EXPECT_EQ(probes[0].x, 36);
  EXPECT_EQ(probes[0].y, 22);
  EXPECT_EQ(probes[0].area, 1.0f);
}

TEST(ChooseProbes, DependsOnTheSeedAlone) {
  const ProbeWeights weights(101, 57, 1.0f);
  EXPECT_TRUE(same(chooseProbes(weights, 0.02, 1), chooseProbes(weights, 0.02, 1)));
  EXPECT_FALSE(same(chooseProbes(weights, 0.02, 1), chooseProbes(weights, 0.02, 2)));
}

TEST(ChooseProbes, LooksAtEverySampleAsOften) {
  // 4000 seeds, a probability of 1/25 each: 160 on average, standard deviation sqrt(160 * 0.96) = 12.4. Five
  // of these, because there are 117 samples.
  Image<int> counts(13, 9);
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    for (const Probe& probe : chooseProbes(ProbeWeights(13, 9, 1.0f), 0.04, seed)) ++counts(probe.x, probe.y);
  }
  for (const int count : counts.pixels()) EXPECT_NEAR(count, 160, 62);
}

}  // namespace
}  // namespace promenade::walkthrough
