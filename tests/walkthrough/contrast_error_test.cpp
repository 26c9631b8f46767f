#include "src/walkthrough/contrast_error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace promenade::walkthrough {
namespace {

constexpr Size kProbedSize{100, 60};
constexpr double kSpacing = 5.0;

/// One probe in each square of 5x5 pixels, somewhere in it.
std::vector<ProbeError> probesWith(const std::function<float(glm::vec2)>& errorAt) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(0.0f, 5.0f);
  std::vector<ProbeError> probes;
  for (int y = 0; y < kProbedSize.height; y += 5) {
    for (int x = 0; x < kProbedSize.width; x += 5) {
      const glm::vec2 pixel(static_cast<float>(x) + place(random), static_cast<float>(y) + place(random));
      probes.push_back({pixel, errorAt(pixel)});
    }
  }
  return probes;
}

double share(const ContrastErrorMap& map, const std::function<bool(float)>& isCounted) {
  double count = 0.0;
  for (const float error : map.pixels()) count += isCounted(error) ? 1.0 : 0.0;
  return count / static_cast<double>(map.pixels().size());
}

TEST(ContrastErrors, ShowWhatAllProbesSay) {
  const auto errors = contrastErrors(kProbedSize, probesWith([](glm::vec2) { return -0.25f; }), kSpacing);
  // Not in the corners, where a quarter of the window is left: fewer than four probes.
  for (int y = 5; y < kProbedSize.height - 5; ++y) {
    for (int x = 5; x < kProbedSize.width - 5; ++x)
      ASSERT_NEAR(errors(x, y), -0.25f, 1e-5f) << x << ", " << y;
  }
}

TEST(ContrastErrors, AreZeroWhereThereIsOnlyNoise) {
  std::mt19937 random(7);
  // Skewed as the noise of path tracing: a third of the mean, towards bright values.
  std::exponential_distribution<float> exponential;
  const auto noise = [&](glm::vec2) { return std::log(1.0f + 0.33f * (exponential(random) - 1.0f)); };
  const auto errors = contrastErrors(kProbedSize, probesWith(noise), kSpacing);
  EXPECT_LT(share(errors, [](float e) { return e != 0.0f; }), 0.05);
  // The mean itself deviates by 0.33 / sqrt(4 pi probes under a window) = 0.09, so that without the three
  // standard errors three quarters of the pixels would be above 0.03.
  EXPECT_LT(share(errors, [](float e) { return std::abs(e) > 0.03f; }), 0.02);
}

TEST(ContrastErrors, AreZeroWhereEdgesAreOffInBothDirections) {
  std::mt19937 random(7);
  std::bernoulli_distribution coin;
  const auto errors = contrastErrors(
      kProbedSize, probesWith([&](glm::vec2) { return coin(random) ? 0.5f : -0.5f; }), kSpacing);
  EXPECT_LT(share(errors, [](float e) { return e != 0.0f; }), 0.05);
}

TEST(ContrastErrors, FindAPatchInNoise) {
  std::mt19937 random(7);
  std::normal_distribution<float> noise(0.0f, 0.1f);
  const auto isInPatch = [](glm::vec2 p) {
    return std::abs(p.x - 50.0f) < 15.0f && std::abs(p.y - 30.0f) < 15.0f;
  };
  const auto errors = contrastErrors(
      kProbedSize, probesWith([&](glm::vec2 p) { return noise(random) + (isInPatch(p) ? 0.5f : 0.0f); }),
      kSpacing);
  // In its middle, but for three standard errors of 0.1 / sqrt(4 pi - 1) = 0.03.
  EXPECT_NEAR(errors(50, 30), 0.4f, 0.1f);
  EXPECT_EQ(errors(10, 10), 0.0f);
  EXPECT_EQ(errors(90, 50), 0.0f);
}

TEST(ContrastErrors, WeighProbesByWhatTheyStandFor) {
  // Twice as many probes on the left half of every square, of half the area each: as if they were even.
  std::vector<ProbeError> probes;
  for (int y = 0; y < kProbedSize.height; y += 2) {
    for (int x = 0; x < kProbedSize.width; x += 4) {
      const glm::vec2 pixel(static_cast<float>(x), static_cast<float>(y));
      probes.push_back({pixel, 0.2f, 1.0f});
      probes.push_back({pixel, 0.2f, 1.0f});
      probes.push_back({pixel + glm::vec2(2.0f, 0.0f), 0.4f, 2.0f});
    }
  }
  // Less three standard errors of 0.1 / sqrt(8 pi 25 / 8 * ...): under a window of 5 pixels there are 4 pi 25
  // = 314 pixels, so 314 / 8 * 3 * 8/9 = 105 probes of equal weight; 0.3 - 3 * 0.1 / sqrt(104) = 0.27.
  EXPECT_NEAR(contrastErrors(kProbedSize, probes, kSpacing)(50, 30), 0.27f, 0.003f);
}

TEST(ContrastErrors, SayNothingWithTooFewProbes) {
  const std::vector<ProbeError> three{{{10, 10}, 1.0f}, {{12, 10}, 1.0f}, {{10, 12}, 1.0f}};
  EXPECT_THAT(contrastErrors(kProbedSize, three, kSpacing).pixels(), testing::Each(0.0f));
  EXPECT_THAT(contrastErrors({1, 1}, {}, kSpacing).pixels(), testing::Each(0.0f));
}

}  // namespace
}  // namespace promenade::walkthrough
