#include "src/render/texture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "src/core/display.h"

namespace promenade::render {
namespace {

using Texel = std::array<std::uint8_t, 4>;

/// A scene with one material whose base colour is one texture of one image.
Scene sceneOf(Size size, const std::function<Texel(int, int)>& texel, Texture texture = {}) {
  Scene scene;
  scene.images.push_back({"image", Image<Texel>(size)});
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) scene.images[0].texels(x, y) = texel(x, y);
  }
  scene.materials.emplace_back();
  texture.image = 0;
  scene.materials[0].baseColorTexture = texture;
  return scene;
}

std::uint8_t byteOf(int v) {
  return static_cast<std::uint8_t>(v);
}

Texel grey(int v) {
  return {byteOf(v), byteOf(v), byteOf(v), 255};
}

/// Red of a lookup, in 1 / 255.
float red(const Scene& scene, glm::vec2 uv, float footprint = 0.0f) {
  const TextureLibrary library(scene);
  return 255.0f * library.sample(*scene.materials[0].baseColorTexture, uv, footprint).r;
}

Texture withWrap(Wrap wrap, Filter filter = Filter::kLinear) {
  Texture texture;
  texture.wrapU = wrap;
  texture.wrapV = wrap;
  texture.magnification = filter;
  return texture;
}

const auto kFourColumns = [](int x, int) { return grey(40 * x); };  // 0 40 80 120 at u = 1/8 3/8 5/8 7/8

TEST(TextureLibrary, ReadsTexelCentresExactlyAndMixesBetweenThem) {
  const Scene scene = sceneOf({4, 1}, kFourColumns);
  EXPECT_NEAR(red(scene, {0.125f, 0.5f}), 0.0f, 1e-3f);
  EXPECT_NEAR(red(scene, {0.375f, 0.5f}), 40.0f, 1e-3f);
  EXPECT_NEAR(red(scene, {0.5f, 0.5f}), 60.0f, 1e-3f);
  EXPECT_NEAR(red(scene, {0.6875f, 0.5f}), 90.0f, 1e-3f);  // a quarter of the way from 80 to 120
}

TEST(TextureLibrary, ReadsTheNearestTexelWhenAsked) {
  const Scene scene = sceneOf({4, 1}, kFourColumns, withWrap(Wrap::kRepeat, Filter::kNearest));
  EXPECT_NEAR(red(scene, {0.26f, 0.5f}), 40.0f, 1e-3f);
  EXPECT_NEAR(red(scene, {0.49f, 0.5f}), 40.0f, 1e-3f);
  EXPECT_NEAR(red(scene, {-0.01f, 0.5f}), 120.0f, 1e-3f);
}

TEST(TextureLibrary, HasTheFirstRowAtTheTopOfTheImage) {
  const Scene scene = sceneOf({1, 2}, [](int, int y) { return grey(y == 0 ? 10 : 200); });
  EXPECT_NEAR(red(scene, {0.5f, 0.25f}), 10.0f, 1e-3f);
  EXPECT_NEAR(red(scene, {0.5f, 0.75f}), 200.0f, 1e-3f);
}

TEST(TextureLibrary, RepeatsMirrorsAndClamps) {
  const Scene repeat = sceneOf({4, 1}, kFourColumns, withWrap(Wrap::kRepeat));
  EXPECT_NEAR(red(repeat, {-0.625f, 0.5f}), 40.0f, 1e-3f);
  EXPECT_NEAR(red(repeat, {2.375f, -7.5f}), 40.0f, 1e-3f);
  EXPECT_NEAR(red(repeat, {0.0f, 0.5f}), 60.0f, 1e-3f);  // half 120, half 0
  const Scene mirror = sceneOf({4, 1}, kFourColumns, withWrap(Wrap::kMirroredRepeat));
  EXPECT_NEAR(red(mirror, {-0.375f, 0.5f}), 40.0f, 1e-3f);
  EXPECT_NEAR(red(mirror, {1.375f, 0.5f}), 80.0f, 1e-3f);
  EXPECT_NEAR(red(mirror, {2.375f, 0.5f}), 40.0f, 1e-3f);
  EXPECT_NEAR(red(mirror, {0.0f, 0.5f}), 0.0f, 1e-3f);  // the edge texel meets its image
  const Scene clamp = sceneOf({4, 1}, kFourColumns, withWrap(Wrap::kClampToEdge));
  EXPECT_NEAR(red(clamp, {-3.0f, 0.5f}), 0.0f, 1e-3f);
  EXPECT_NEAR(red(clamp, {17.0f, 0.5f}), 120.0f, 1e-3f);
}

TEST(TextureLibrary, SurvivesAnyCoordinatesAndFootprint) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const float values[] = {nan, inf, -inf, 3e38f, -3e38f, 1e9f, -1e-45f, 0.99999994f, 16777216.0f, 0.0f};
  for (const Size size : {Size{1, 1}, Size{3, 5}, Size{1, 7}, Size{8, 2}}) {
    for (const Wrap wrap : {Wrap::kRepeat, Wrap::kMirroredRepeat, Wrap::kClampToEdge}) {
      for (const Filter filter : {Filter::kLinear, Filter::kNearest}) {
        const Scene scene = sceneOf(
            size, [](int x, int y) { return grey(x + 8 * y); }, withWrap(wrap, filter));
        const TextureLibrary library(scene);
        for (const float u : values) {
          for (const float footprint : {0.0f, 0.3f, 1e30f, inf, nan, -1.0f}) {
            const glm::vec4 v = library.sample(*scene.materials[0].baseColorTexture, {u, -u}, footprint);
            ASSERT_TRUE(v.r >= 0.0f && v.r <= 1.0f) << u << " " << footprint;
          }
        }
      }
    }
  }
}

TEST(TextureLibrary, DecodesSrgbColourButNotAlpha) {
  Texture texture;
  texture.encoding = TexelEncoding::kSrgb;
  const Scene scene = sceneOf(
      {1, 1},
      [](int, int) {
        return Texel{188, 0, 255, 188};
      },
      texture);
  const TextureLibrary library(scene);
  const glm::vec4 v = library.sample(*scene.materials[0].baseColorTexture, {0.3f, 0.3f}, 0.0f);
  EXPECT_NEAR(v.r, 0.5029f, 1e-4f);  // ((188 / 255 + 0.055) / 1.055)^2.4
  EXPECT_EQ(v.g, 0.0f);
  EXPECT_NEAR(v.b, 1.0f, 1e-6f);
  EXPECT_NEAR(v.a, 188.0f / 255.0f, 1e-6f);
}

TEST(TextureLibrary, AveragesInLinearLight) {
  // Half black, half white is linear 1/2, which sRGB writes as 188; the mean of the code values would be 128.
  Texture texture;
  texture.encoding = TexelEncoding::kSrgb;
  const auto checkers = [](int x, int y) { return grey((x + y) % 2 == 0 ? 0 : 255); };
  const Scene scene = sceneOf({64, 64}, checkers, texture);
  const TextureLibrary library(scene);
  for (const float footprint : {2.0f / 64.0f, 0.1f, 1.0f, 50.0f}) {
    const glm::vec4 v = library.sample(*scene.materials[0].baseColorTexture, {0.3f, 0.7f}, footprint);
    EXPECT_NEAR(v.r, 0.5f, 0.004f) << footprint;
  }
}

TEST(TextureLibrary, KeepsTheMeanOfOddSizes) {
  // Halving 3 texels to 1 gives each a third; 5 to 2 to 1 gives each a fifth (2/5 2/5 1/5, 1/5 2/5 2/5, then
  // halves).
  std::mt19937 random(3);
  for (const Size size : {Size{3, 1}, Size{1, 5}, Size{5, 3}, Size{7, 9}, Size{33, 17}, Size{2, 31}}) {
    double sum = 0.0;
    const Scene scene = sceneOf(size, [&](int, int) {
      const int v = static_cast<int>(random() % 256);
      sum += v;
      return grey(v);
    });
    // Each level is rounded to 8 bits: half a step each.
    EXPECT_NEAR(red(scene, {0.4f, 0.4f}, 100.0f), sum / static_cast<double>(size.area()), 2.0)
        << size.width << " x " << size.height;
  }
  EXPECT_NEAR(red(sceneOf({3, 1}, [](int x, int) { return grey(x == 2 ? 255 : 0); }), {0.0f, 0.0f}, 9.0f),
              85.0f, 0.5f);
}

TEST(TextureLibrary, BlursGraduallyWithTheFootprint) {
  const Scene scene = sceneOf(
      {64, 64}, [](int x, int) { return grey(x < 32 ? 0 : 255); }, withWrap(Wrap::kClampToEdge));
  float last = -1.0f;
  for (float footprint = 0.01f; footprint < 4.0f; footprint *= 1.07f) {
    const float v = red(scene, {0.2f, 0.5f}, footprint);
    EXPECT_GE(v, last - 0.51f);
    if (last >= 0.0f) {
      EXPECT_LT(v - last, 25.0f) << "no jumps between levels, at " << footprint;
    }
    last = v;
  }
  EXPECT_NEAR(last, 127.5f, 1.0f);
}

TEST(TextureLibrary, AppliesTheTransformToCoordinatesAndFootprint) {
  // KHR_texture_transform with scale 2 and offset 1/4: u' = 2 u + 1/4.
  Texture texture = withWrap(Wrap::kRepeat, Filter::kNearest);
  texture.transform = glm::mat3(2.0f, 0.0f, 0.0f, 0.0f, 2.0f, 0.0f, 0.25f, 0.0f, 1.0f);
  const Scene scene = sceneOf({4, 4}, kFourColumns, texture);
  EXPECT_NEAR(red(scene, {0.06f, 0.1f}), 40.0f, 1e-3f);   // u' = 0.37
  EXPECT_NEAR(red(scene, {0.30f, 0.1f}), 120.0f, 1e-3f);  // u' = 0.85
  // A footprint of half the coordinates is all of the texture.
  EXPECT_NEAR(red(scene, {0.06f, 0.1f}, 0.5f), 60.0f, 0.6f);
}

TEST(TextureLibrary, DoesNotFilterWhatAsksForNoMipmaps) {
  Texture texture;
  texture.mipmapped = false;
  const Scene scene = sceneOf({4, 1}, kFourColumns, texture);
  EXPECT_NEAR(red(scene, {0.375f, 0.5f}, 1.0f), 40.0f, 1e-3f);
  EXPECT_EQ(TextureLibrary(scene).bytes(), 0u);
}

TEST(TextureLibrary, AddsAThirdOfTheImageInMemory) {
  // 4 x 4 has levels of 4 and 1 texels above it: 20 bytes, once for each encoding that is read.
  Scene scene = sceneOf({4, 4}, kFourColumns);
  EXPECT_EQ(TextureLibrary(scene).bytes(), 20u);
  scene.materials[0].normalTexture = scene.materials[0].baseColorTexture;
  EXPECT_EQ(TextureLibrary(scene).bytes(), 20u);
  scene.materials[0].emissionTexture = scene.materials[0].baseColorTexture;
  scene.materials[0].emissionTexture->encoding = TexelEncoding::kSrgb;
  EXPECT_EQ(TextureLibrary(scene).bytes(), 40u);
}

TEST(TextureLibrary, BuildsThePyramidIfAnyUseOfTheImageWantsIt) {
  Scene scene = sceneOf({4, 4}, [](int x, int y) { return grey((x + y) % 2 == 0 ? 0 : 254); });
  scene.materials[0].baseColorTexture->mipmapped = false;
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].baseColorTexture->mipmapped = true;
  scene.materials.push_back(scene.materials[0]);
  const TextureLibrary library(scene);
  EXPECT_NEAR(255.0f * library.sample(*scene.materials[1].baseColorTexture, {0.1f, 0.1f}, 5.0f).r, 127.0f,
              0.6f);
  EXPECT_NEAR(255.0f * library.sample(*scene.materials[2].baseColorTexture, {0.125f, 0.125f}, 5.0f).r, 0.0f,
              1e-3f);
}

}  // namespace
}  // namespace promenade::render
