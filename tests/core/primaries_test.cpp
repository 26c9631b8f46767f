#include "src/core/primaries.h"

#include <gtest/gtest.h>

#include <glm/vec3.hpp>

namespace promenade {
namespace {

void expectNear(const glm::dvec3& found, const glm::dvec3& expected, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], tolerance) << i;
}

TEST(Primaries, GiveTheMatrixOfTheStandard) {
  // IEC 61966-2-1, its inverse rounded to four places: rows X, Y, Z.
  const glm::dmat3 m = xyzFromRgb({});
  expectNear(m[0], {0.4124, 0.2126, 0.0193}, 5e-5);
  expectNear(m[1], {0.3576, 0.7152, 0.1192}, 5e-5);
  expectNear(m[2], {0.1805, 0.0722, 0.9505}, 5e-5);
}

TEST(Primaries, ShineInWhiteInTheProportionsThatGiveIt) {
  // Two lights on the line y = 1/3 and one above: red (1/2, 1/3), blue (1/6, 1/3), green (1/3, 2/3), white
  // (1/3, 4/9). In XYZ per unit of luminance: (3/2, 1, 1/2), (1/2, 1, 3/2), (1/2, 1, 0) and (3/4, 1, 1/2).
  // Shares r, g, b: r + g + b = 1; X: 3r/2 + g/2 + b/2 = 3/4, so r + 1/2 = 3/4, r = 1/4; Z: r/2 + 3b/2 = 1/2,
  // b = 1/4; g = 1/2.
  const Primaries p{{0.5, 1.0 / 3}, {1.0 / 3, 2.0 / 3}, {1.0 / 6, 1.0 / 3}, {1.0 / 3, 4.0 / 9}};
  ASSERT_TRUE(arePossible(p));
  const glm::dmat3 m = xyzFromRgb(p);
  expectNear({m[0].y, m[1].y, m[2].y}, {0.25, 0.5, 0.25}, 1e-12);
}

TEST(Primaries, OfRec709AreThemselves) {
  const glm::dmat3 m = rgbFromRec709({});
  expectNear(m * glm::dvec3(0.2, 0.5, 0.7), {0.2, 0.5, 0.7}, 1e-12);
}

TEST(Primaries, WhiteStaysWhiteWhateverTheWhiteIs) {
  // The white of D50, ICC.1:2022.
  const Primaries d50{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3457, 0.3585}};
  expectNear(rgbFromRec709(d50) * glm::dvec3(1.0), glm::dvec3(1.0), 1e-12);
  EXPECT_FALSE(rgbFromRec709(d50) == rgbFromRec709({}));
}

TEST(Primaries, ThatNoDisplayHasAreImpossible) {
  EXPECT_TRUE(arePossible({}));
  EXPECT_FALSE(arePossible({{0.1, 0.1}, {0.2, 0.2}, {0.3, 0.3}, {0.25, 0.25}}));          // a line
  EXPECT_FALSE(arePossible({{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.6, 0.39}}));     // white outside
  EXPECT_FALSE(arePossible({{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.0}, {0.3127, 0.329}}));  // no luminance
  EXPECT_FALSE(
      arePossible({{0.64, 0.43}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.329}}));  // beyond all colours
}

}  // namespace
}  // namespace promenade
