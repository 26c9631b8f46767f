#include "src/scene/sky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "src/core/display.h"
#include "src/core/errors.h"

namespace promenade {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

float luminanceAt(const Environment& sky, int x, int y) {
  return luminance(sky.radiance(x, y));
}

TEST(ClearSky, IsPositiveAndFiniteEverywhere) {
  for (const double elevation : {0.0, 2.0, 30.0, 60.0, 90.0}) {
    for (const double turbidity : {1.7, 2.5, 6.0, 10.0}) {
      const Environment sky = clearSky(elevation * kDegree, 1.0, turbidity);
      for (const Rgb& radiance : sky.radiance.pixels()) {
        for (int i = 0; i < 3; ++i) {
          ASSERT_TRUE(std::isfinite(radiance[i])) << elevation << ' ' << turbidity;
          ASSERT_GE(radiance[i], 0.0f) << elevation << ' ' << turbidity;
        }
        ASSERT_GT(luminance(radiance), 0.0f) << elevation << ' ' << turbidity;
      }
    }
  }
}

TEST(ClearSky, HasLuminanceOneAtTheZenith) {
  const Environment sky = clearSky(40.0 * kDegree, 0.3, 3.0, SunDisc::kNone);
  // The top row lies within 0.35 degrees of the zenith, where luminance changes by well under 2%.
  for (int x = 0; x < sky.radiance.width(); ++x) {
    EXPECT_NEAR(luminanceAt(sky, x, 0), 1.0f, 0.02f);
  }
}

TEST(ClearSky, IsSymmetricAboutThePlaneOfTheSun) {
  // The sun stands toward -Z, the centre of the image, so the image is its own mirror.
  const Environment sky = clearSky(35.0 * kDegree, 0.0, 3.0);
  const int width = sky.radiance.width();
  for (int y = 0; y < sky.radiance.height(); ++y) {
    for (int x = 0; x < width / 2; ++x) {
      ASSERT_NEAR(luminanceAt(sky, x, y), luminanceAt(sky, width - 1 - x, y), 1e-4f * luminanceAt(sky, x, y));
    }
  }
}

TEST(ClearSky, TurnsWithTheSun) {
  // A quarter turn of the sun moves the image by a quarter of its width, 128 pixels.
  const Environment north = clearSky(35.0 * kDegree, 0.0, 3.0);
  const Environment east = clearSky(35.0 * kDegree, std::numbers::pi / 2.0, 3.0);
  for (int y = 0; y < north.radiance.height(); y += 7) {
    for (int x = 0; x + 128 < north.radiance.width(); ++x) {
      ASSERT_NEAR(luminanceAt(east, x + 128, y), luminanceAt(north, x, y), 1e-4f * luminanceAt(north, x, y));
    }
  }
}

TEST(ClearSky, IsBrightestAtTheSun) {
  const double elevation = 30.0 * kDegree;
  const Environment sky = clearSky(elevation, 0.0, 3.0);
  int brightestX = 0;
  int brightestY = 0;
  for (int y = 0; y < sky.radiance.height(); ++y) {
    for (int x = 0; x < sky.radiance.width(); ++x) {
      if (luminanceAt(sky, x, y) > luminanceAt(sky, brightestX, brightestY)) {
        brightestX = x;
        brightestY = y;
      }
    }
  }
  // v = acos(sin 30 degrees) / pi = 60/180 of 256 rows = 85.3; u = 0.5.
  EXPECT_NEAR(brightestX + 0.5, 256.0, 1.0);
  EXPECT_NEAR(brightestY + 0.5, 85.3, 1.0);
}

TEST(ClearSky, IsBrighterAtTheHorizonThanAtTheZenithAndMoreSoWhenClear) {
  // Opposite to a sun at 40 degrees. Preetham's equation 3 with gamma = 90 and 140 degrees: for turbidity 2,
  // (1 + a e^(b/cos theta)) goes from 1 - 1.1056 e^-0.2833 = 0.167 at the zenith toward 1 at the horizon.
  const auto ratio = [](double turbidity) {
    const Environment sky = clearSky(40.0 * kDegree, 0.0, turbidity, SunDisc::kNone);
    return luminanceAt(sky, 0, sky.radiance.height() / 2 - 2) / luminanceAt(sky, 0, 0);
  };
  EXPECT_GT(ratio(2.0), 1.5f);
  EXPECT_LT(ratio(2.0), 6.0f);
  EXPECT_GT(ratio(2.0), ratio(6.0));
}

TEST(ClearSky, IsBlueAtTheZenith) {
  const Environment sky = clearSky(45.0 * kDegree, 0.0, 2.5, SunDisc::kNone);
  EXPECT_GT(sky.radiance(0, 0).z, 1.3f * sky.radiance(0, 0).x);
}

TEST(ClearSky, GetsMostOfItsIrradianceFromAHighSun) {
  const auto irradiance = [](SunDisc sun) {
    const Environment sky = clearSky(60.0 * kDegree, 0.0, 2.5, sun);
    const double step = std::numbers::pi / sky.radiance.height();
    double sum = 0.0;
    for (int y = 0; y < sky.radiance.height() / 2; ++y) {
      const double theta = (y + 0.5) * step;
      for (int x = 0; x < sky.radiance.width(); ++x) {
        sum += luminanceAt(sky, x, y) * std::cos(theta) * std::sin(theta) * step * step;
      }
    }
    return sum;
  };
  // Under a clear sky direct sun gives some 4 to 12 times the illuminance of the sky.
  const double ratio = (irradiance(SunDisc::kSoft) - irradiance(SunDisc::kNone)) / irradiance(SunDisc::kNone);
  EXPECT_GT(ratio, 3.0);
  EXPECT_LT(ratio, 15.0);
}

TEST(ClearSky, RefusesWhatTheModelDoesNotCover) {
  EXPECT_THROW(static_cast<void>(clearSky(-0.1, 0.0, 3.0)), InputError);
  EXPECT_THROW(static_cast<void>(clearSky(1.7, 0.0, 3.0)), InputError);
  EXPECT_THROW(static_cast<void>(clearSky(1.0, 0.0, 1.0)), InputError);
  EXPECT_THROW(static_cast<void>(clearSky(1.0, 0.0, 11.0)), InputError);
  EXPECT_THROW(static_cast<void>(clearSky(1.0, NAN, 3.0)), InputError);
}

}  // namespace
}  // namespace promenade
