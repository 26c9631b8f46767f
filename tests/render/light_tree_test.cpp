// Choosing between many lights.

#include "src/render/light_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace promenade::render {
namespace {

std::vector<LightBounds> randomLights(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
  std::vector<LightBounds> lights;
  for (int i = 0; i < count; ++i) {
    LightBounds b;
    b.lower = 10.0f * glm::vec3(unit(random), unit(random), unit(random));
    b.upper = b.lower + 0.1f * glm::vec3(1.0f + unit(random), 1.0f + unit(random), 1.0f + unit(random));
    b.axis = glm::vec3(std::sin(0.1f * static_cast<float>(i)), 0.0f, std::cos(0.1f * static_cast<float>(i)));
    b.intensity = 1.5f + unit(random);
    b.bothSides = i % 3 == 0;
    if (i % 5 == 0) b.cosThetaO = -1.0f;
    lights.push_back(b);
  }
  return lights;
}

TEST(LightTree, OfNoLightsChoosesNone) {
  const LightTree tree({});
  EXPECT_FALSE(tree.choose({0, 0, 0}, {0, 0, 1}, 0.5f).has_value());
}

TEST(LightTree, OfOneLightAlwaysChoosesIt) {
  const LightTree tree(randomLights(1));
  const auto choice = tree.choose({0, 0, 0}, {0, 0, 1}, 0.7f);
  ASSERT_TRUE(choice.has_value());
  EXPECT_EQ(choice->light, 0u);
  EXPECT_EQ(choice->probability, 1.0f);
}

TEST(LightTree, ProbabilityIsThatOfChoosing) {
  for (const int count : {2, 3, 17, 100}) {
    const LightTree tree(randomLights(count));
    const glm::vec3 position(1.0f, -2.0f, 3.0f), normal(0.0f, 1.0f, 0.0f);
    constexpr int kDraws = 200000;
    std::vector<int> chosen(static_cast<std::size_t>(count), 0);
    for (int i = 0; i < kDraws; ++i) {
      const auto choice = tree.choose(position, normal, (static_cast<float>(i) + 0.5f) / kDraws);
      if (!choice) continue;
      ++chosen[choice->light];
      ASSERT_NEAR(choice->probability, tree.probability(choice->light, position, normal), 1e-5f);
    }
    for (int i = 0; i < count; ++i) {
      // Draws are evenly spaced, and every light takes one interval of u: off by at most a draw at each end,
      // and rounding.
      EXPECT_NEAR(chosen[static_cast<std::size_t>(i)] / double{kDraws},
                  tree.probability(static_cast<std::uint32_t>(i), position, normal), 1e-4);
    }
  }
}

// More inner nodes than a view remembers, so that some are forgotten and worked out again.
TEST(LightTree, SeenFromAPlaceChoosesTheSame) {
  for (const int count : {0, 1, 2, 1000}) {
    const std::vector<LightBounds> lights = count > 0 ? randomLights(count) : std::vector<LightBounds>();
    const LightTree tree(lights);
    const glm::vec3 position(1.0f, -2.0f, 3.0f), normal(0.0f, 1.0f, 0.0f);
    LightTree::View view(tree, position, normal);
    constexpr int kDraws = 5000;
    for (int i = 0; i < kDraws; ++i) {
      // Far apart from one to the next.
      const float u = static_cast<float>(i * 2003 % kDraws) / kDraws;
      const auto expected = tree.choose(position, normal, u);
      const auto choice = view.choose(u);
      ASSERT_EQ(choice.has_value(), expected.has_value());
      if (!expected) continue;
      ASSERT_EQ(choice->light, expected->light);
      ASSERT_EQ(choice->probability, expected->probability);
    }
  }
}

TEST(LightTree, PrefersTheNearerOfTwoEqualLights) {
  std::vector<LightBounds> lights(2);
  lights[0].lower = lights[0].upper = {0.0f, 1.0f, 0.0f};
  lights[1].lower = lights[1].upper = {0.0f, 10.0f, 0.0f};
  for (LightBounds& light : lights) {
    light.intensity = 1.0f;
    light.cosThetaO = -1.0f;
  }
  // Both straight above: shares 1/1 and 1/100.
  EXPECT_NEAR(LightTree(lights).probability(0, {0, 0, 0}, {0, 1, 0}), 100.0f / 101.0f, 1e-4f);
}

TEST(LightTree, DoesNotChooseALightThatFacesAway) {
  std::vector<LightBounds> lights(2);
  lights[0].lower = {-1.0f, 1.0f, -1.0f};
  lights[0].upper = {1.0f, 1.0f, 1.0f};
  lights[0].axis = {0.0f, 1.0f, 0.0f};
  lights[0].intensity = 100.0f;
  lights[1].lower = lights[1].upper = {0.0f, 9.0f, 0.0f};
  lights[1].axis = {0.0f, -1.0f, 0.0f};
  lights[1].intensity = 1.0f;
  EXPECT_EQ(LightTree(lights).probability(0, {0, -5, 0}, {0, 1, 0}), 0.0f);
}

}  // namespace
}  // namespace promenade::render
