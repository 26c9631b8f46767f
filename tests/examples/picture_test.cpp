#include "examples/hall/picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "examples/hall/paintings.h"

namespace promenade::hall {
namespace {

TEST(HallPicture, NoiseRepeatsAfterItsPeriod) {
  for (double x = 0.05; x < 3.0; x += 0.37) {
    EXPECT_NEAR(gradientNoise(x, 0.4, 3, 5, 7), gradientNoise(x + 3.0, 5.4, 3, 5, 7), 1e-12);
    EXPECT_NEAR(fractalNoise(0.2 * x, 0.3, 4, 3, 7), fractalNoise(0.2 * x + 1.0, -0.7, 4, 3, 7), 1e-12);
  }
}

TEST(HallPicture, NoiseVanishesOnTheLattice) {
  for (int x = -2; x < 5; ++x) EXPECT_DOUBLE_EQ(gradientNoise(x, 3.0, 4, 4, 1), 0.0);
}

TEST(HallPicture, RandomNumbersAreTheSameEverywhere) {
  // SplitMix64 from seed 0: its first output is 0xe220a8397b1dcdaf (Vigna's reference code).
  Random random(0);
  EXPECT_DOUBLE_EQ(random.uniform(), static_cast<double>(0xe220a8397b1dcdafULL >> 11U) * 0x1.0p-53);
}

TEST(HallPicture, ValuesAreRoundedAndClamped) {
  const Picture p =
      paint(2, 1, [](double u, double) { return u < 0.5 ? Color(-1.0, 0.5, 2.0) : Color(0.0, 1.0, 0.25); });
  EXPECT_EQ(p.rgb, (std::vector<std::uint8_t>{0, 128, 255, 0, 255, 64}));
}

TEST(HallPicture, ASlopeTurnsTheNormal) {
  // Rising by 0.1 m a metre to the right: the normal leans left, (-0.1, 0, 1) normalized, as 0.5 n + 0.5.
  const Picture p = normalMap(4, 2.0, [](double u, double) { return 0.1 * 2.0 * u; });
  const double length = std::sqrt(1.01);
  EXPECT_EQ(p.rgb[0], std::lround(255.0 * (0.5 - 0.05 / length)));
  EXPECT_EQ(p.rgb[1], 128);
  EXPECT_EQ(p.rgb[2], std::lround(255.0 * (0.5 + 0.5 / length)));
}

TEST(HallPicture, APaintingHasItsShape) {
  for (const double aspect : {1.5, 1.0, 0.5}) {
    const Picture p = painting(Motif::kGrid, aspect, 60);
    EXPECT_EQ(std::max(p.width, p.height), 60);
    EXPECT_NEAR(static_cast<double>(p.width) / p.height, aspect, 0.05);
    EXPECT_EQ(p.rgb.size(), static_cast<std::size_t>(3 * p.width * p.height));
  }
}

}  // namespace
}  // namespace promenade::hall
