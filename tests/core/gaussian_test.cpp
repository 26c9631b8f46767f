#include "src/core/gaussian.h"

#include <gtest/gtest.h>

#include <cmath>

namespace promenade {
namespace {

TEST(Blurred, KeepsAUniformImageToItsEdges) {
  const RadianceMap image = blurred(RadianceMap(7, 3, Rgb(0.5f, 2.0f, 0.0f)), 4.0);
  for (const Rgb& value : image.pixels()) {
    EXPECT_NEAR(value.r, 0.5f, 1e-6f);
    EXPECT_NEAR(value.g, 2.0f, 1e-5f);
    EXPECT_EQ(value.b, 0.0f);
  }
}

TEST(Blurred, LosesNoLightOfAPoint) {
  RadianceMap image(31, 31);
  image(15, 15) = Rgb(1.0f);
  const RadianceMap spread = blurred(image, 2.0);
  float sum = 0.0f;
  for (const Rgb& value : spread.pixels()) sum += value.g;
  EXPECT_NEAR(sum, 1.0f, 1e-5f);
}

TEST(Blurred, LowersAGratingByTheGaussiansTransform) {
  // exp(-2 pi^2 sigma^2 f^2), sigma = 2, f = 1/16: exp(-0.308425) = 0.734603.
  RadianceMap image(128, 1);
  for (int x = 0; x < 128; ++x)
    image(x, 0) = Rgb(std::cos(2.0f * 3.14159265f * static_cast<float>(x) / 16.0f) + 1.0f);
  EXPECT_NEAR(blurred(image, 2.0)(64, 0).g - 1.0f, 0.7346f, 3e-3f);
}

TEST(Blurred, ByNothingIsTheImage) {
  RadianceMap image(2, 1, Rgb(1.0f));
  image(1, 0) = Rgb(3.0f);
  EXPECT_EQ(blurred(image, 0.0)(1, 0), Rgb(3.0f));
  EXPECT_TRUE(blurred(RadianceMap(), 1.0).empty());
}

}  // namespace
}  // namespace promenade
