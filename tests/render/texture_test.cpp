#include "src/render/texture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <new>
#include <random>
#include <vector>

#include "src/core/display.h"
#include "src/core/errors.h"
#include "src/render/path_renderer.h"
#include "src/render/texture_input_internal.h"
#include "tests/render/scenes.h"

namespace promenade::render {
namespace {

using Texel = std::array<std::uint8_t, 4>;
using tests::textureImage;

/// A scene with one material whose base colour is one texture of one image.
Scene sceneOf(Size size, const std::function<Texel(int, int)>& texel, Texture texture = {}) {
  Scene scene;
  Texels texels(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) texels(x, y) = texel(x, y);
  }
  scene.images.push_back(textureImage(std::move(texels)));
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
float red(const Scene& scene, glm::vec2 uv, const TextureFootprint& footprint) {
  const TextureLibrary library(scene);
  return 255.0f * library.sample(*scene.materials[0].baseColorTexture, uv, footprint).r;
}
float red(const Scene& scene, glm::vec2 uv, float width = 0.0f) {
  return red(scene, uv, TextureFootprint::round(width));
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
            const glm::vec4 v = library.sample(*scene.materials[0].baseColorTexture, {u, -u},
                                               TextureFootprint::round(footprint));
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
  const glm::vec4 v = library.sample(*scene.materials[0].baseColorTexture, {0.3f, 0.3f}, {});
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
    const glm::vec4 v = library.sample(*scene.materials[0].baseColorTexture, {0.3f, 0.7f},
                                       TextureFootprint::round(footprint));
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
}

TEST(TextureLibrary, FollowsALongFootprint) {
  // Black on the left, white on the right; a footprint of 2 texels by 16. Upright 4 texels from the border it
  // sees black only, which one as wide as it is long would not; lying across the border, half of each.
  const auto halves = [](int x, int) { return grey(x < 32 ? 0 : 255); };
  const Scene scene = sceneOf({64, 64}, halves, withWrap(Wrap::kClampToEdge));
  const float narrow = 2.0f / 64.0f;
  const float wide = 16.0f / 64.0f;
  EXPECT_NEAR(red(scene, {0.4375f, 0.5f}, {{0.0f, wide}, {narrow, 0.0f}}), 0.0f, 0.5f);
  EXPECT_GT(red(scene, {0.4375f, 0.5f}, wide), 10.0f);
  EXPECT_NEAR(red(scene, {0.5f, 0.5f}, {{wide, 0.0f}, {0.0f, narrow}}), 127.5f, 1.0f);
  // A quarter of the footprint's length from the border, between a quarter and half of that.
  const float beside = red(scene, {0.5f - wide / 4.0f, 0.5f}, {{wide, 0.0f}, {0.0f, narrow}});
  EXPECT_GT(beside, 255.0f * 0.1f);
  EXPECT_LT(beside, 255.0f * 0.4f);
}

TEST(TextureLibrary, CoversAFootprintThatIsALittleLonger) {
  // Stripes one texel wide under a footprint twice, three times as long as its width of a texel: what is seen
  // may hardly depend on where the stripes lie in it, or they would flicker in a walk.
  const Scene scene = sceneOf({64, 64}, [](int x, int) { return grey(x % 2 == 0 ? 0 : 255); });
  for (const float length : {2.0f, 3.0f, 4.0f}) {
    for (float u = 0.5f; u < 0.54f; u += 0.001f) {
      EXPECT_NEAR(red(scene, {u, 0.5f}, {{length / 64.0f, 0.0f}, {0.0f, 1.0f / 64.0f}}), 127.5f, 45.0f)
          << length << " texels, at " << u;
    }
  }
}

TEST(TextureLibrary, FiltersBothSidesOfAnOblongImage) {
  // Columns of black and white, one texel each: a footprint of two texels is grey however low the image is.
  const auto columns = [](int x, int) { return grey(x % 2 == 0 ? 0 : 255); };
  for (const int height : {4, 64, 256}) {
    const Scene scene = sceneOf({64, height}, columns);
    EXPECT_NEAR(red(scene, {0.2f, 0.5f}, 2.0f / static_cast<float>(std::min(64, height))), 127.5f, 1.0f)
        << height;
    EXPECT_NEAR(red(scene, {0.2f, 0.5f}, {{0.0f, 0.5f}, {2.0f / 64.0f, 0.0f}}), 127.5f, 1.0f) << height;
  }
}

TEST(TextureLibrary, ReadsTheNearestLevelForWhatIsBlurredAnyway) {
  // Columns of black and white pairs: at 1.3 texels level 0 is nearest (log2(1.3) = 0.38), at 3 texels and at
  // 5 level 2 (1.58 and 2.32), where all is grey.
  const auto pairs = [](int x, int) { return grey((x / 2) % 2 == 0 ? 0 : 255); };
  const Scene scene = sceneOf({64, 64}, pairs);
  const auto at = [&](float texels) {
    TextureFootprint footprint = TextureFootprint::round(texels / 64.0f);
    footprint.detail = Detail::kBlurred;
    return red(scene, {0.5f / 64.0f, 0.5f}, footprint);  // the centre of a black texel
  };
  EXPECT_NEAR(at(1.3f), 0.0f, 1e-3f);
  EXPECT_NEAR(at(3.0f), 127.5f, 1.0f);
  EXPECT_NEAR(at(5.0f), 127.5f, 1.0f);
}

TEST(TextureLibrary, NeedsAThirdMoreThanTheImageForItsLevels) {
  // 4 x 4 has levels of 4 and 1 texels above it: 21 texels of 4 bytes, or 8 where sRGB is made linear.
  const Scene scene = sceneOf({4, 4}, kFourColumns);
  EXPECT_EQ(bytesOf({&scene.images[0], TexelEncoding::kLinear, nullptr, {}}), 84u);
  EXPECT_EQ(bytesOf({&scene.images[0], TexelEncoding::kSrgb, nullptr, {}}), 168u);
}

TEST(TextureLibrary, ReadsOneImageInTwoEncodings) {
  Scene scene = sceneOf({1, 1}, [](int, int) { return grey(188); });
  scene.materials[0].emissionTexture = scene.materials[0].baseColorTexture;
  scene.materials[0].emissionTexture->encoding = TexelEncoding::kSrgb;
  const TextureLibrary library(scene);
  EXPECT_NEAR(library.sample(*scene.materials[0].baseColorTexture, {0.5f, 0.5f}, {}).r, 188.0f / 255.0f,
              1e-6f);
  EXPECT_NEAR(library.sample(*scene.materials[0].emissionTexture, {0.5f, 0.5f}, {}).r, 0.5029f, 1e-4f);
}

/// Six textures of noise, 17 MB with their levels.
Scene sceneOfNoise(int megabytes) {
  std::mt19937 random(5);
  Scene scene;
  scene.textureMegabytes = megabytes;
  for (int i = 0; i < 6; ++i) {
    Texels texels(Size{512, 512});
    for (Texel& texel : texels.pixels()) texel = grey(static_cast<int>(random() % 256));
    scene.images.push_back(textureImage(std::move(texels)));
    scene.materials.emplace_back();
    Texture texture;
    texture.image = i;
    texture.encoding = TexelEncoding::kSrgb;
    scene.materials.back().baseColorTexture = texture;
  }
  return scene;
}

std::vector<glm::vec4> lookups(const Scene& scene, const TextureLibrary& library) {
  std::vector<glm::vec4> result(120);
  tbb::parallel_for(std::size_t{0}, result.size(), [&](std::size_t i) {
    std::mt19937 random(static_cast<unsigned>(i));
    std::uniform_real_distribution<float> uniform;
    const Texture& texture = *scene.materials[random() % 6].baseColorTexture;
    const glm::vec2 uv{uniform(random), uniform(random)};
    result[i] = library.sample(texture, uv, TextureFootprint::round(0.02f * uniform(random)));
  });
  return result;
}

TEST(TextureLibrary, GivesTheSameWhateverItsMemoryAndThreads) {
  const Scene roomy = sceneOfNoise(64);
  const TextureLibrary keeps(roomy);
  tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
  const std::vector<glm::vec4> expected = lookups(roomy, keeps);
  EXPECT_EQ(keeps.use().levelsReadAgain, 0);

  const Scene scarce = sceneOfNoise(10);
  const TextureLibrary drops(scarce);
  EXPECT_EQ(lookups(scarce, drops), expected);
  EXPECT_GT(drops.use().levelsReadAgain, 0);
  // What one thread looks at, and the level it asked for beyond the budget, are 2 MB each.
  EXPECT_LT(drops.use().bytes, std::size_t{16} << 20);
}

TEST(TextureLibrary, GivesTheSameFromAnyNumberOfThreads) {
  const Scene scene = sceneOfNoise(10);
  const std::vector<glm::vec4> many = lookups(scene, TextureLibrary(scene));
  tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(lookups(scene, TextureLibrary(scene)), many);
}

/// An image that could be decoded when the scene was loaded, and now cannot.
class LostTexels : public TexelSource {
 public:
  [[nodiscard]] Texels texels() const override { throw std::bad_alloc(); }
  [[nodiscard]] std::span<const std::uint8_t> bytes() const override { return {}; }
};

TEST(TextureLibrary, SaysWhichImageCannotBeDecodedAgain) {
  Scene scene = sceneOf({4, 4}, kFourColumns);
  scene.images[0].source = std::make_shared<LostTexels>();
  scene.images[0].name = "marble.png";
  const TextureLibrary library(scene);
  try {
    (void)library.sample(*scene.materials[0].baseColorTexture, {0.5f, 0.5f}, {});
    FAIL() << "expected CannotContinue";
  } catch (const CannotContinue& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("marble.png"));
  }
}

TEST(TextureLibrary, FiltersForTheUsesOfAnImageThatWantIt) {
  Scene scene = sceneOf({4, 4}, [](int x, int y) { return grey((x + y) % 2 == 0 ? 0 : 254); });
  scene.materials[0].baseColorTexture->mipmapped = false;
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].baseColorTexture->mipmapped = true;
  scene.materials.push_back(scene.materials[0]);
  const TextureLibrary library(scene);
  EXPECT_NEAR(
      255.0f *
          library.sample(*scene.materials[1].baseColorTexture, {0.1f, 0.1f}, TextureFootprint::round(5.0f)).r,
      127.0f, 0.6f);
  EXPECT_NEAR(255.0f * library
                           .sample(*scene.materials[2].baseColorTexture, {0.125f, 0.125f},
                                   TextureFootprint::round(5.0f))
                           .r,
              0.0f, 1e-3f);
}

/// Normals that lean by 30 degrees to the right and to the left, column by column.
Texel leaning(int x, int /*y*/) {
  return {byteOf(x % 2 == 0 ? 191 : 64), 128, 238, 77};  // (0.5, 0, 0.866)
}

Texture ofNormals() {
  Texture texture;
  texture.encoding = TexelEncoding::kNormal;
  return texture;
}

TEST(TextureLibrary, TellsHowFarNormalsVaryWithinAFootprint) {
  const Scene scene = sceneOf({16, 16}, leaning, ofNormals());
  const TextureLibrary library(scene);
  const auto at = [&](float width) {
    return library.sample(*scene.materials[0].baseColorTexture, {0.40625f, 0.40625f},
                          TextureFootprint::round(width));
  };
  // Level 1 and all after it: half lean one way, half the other. Mean (0, 0, 0.866), variance 0.5^2.
  for (const float width : {0.125f, 0.25f, 0.5f, 1.0f}) {
    EXPECT_NEAR(at(width).r, 0.5f, 0.003f) << width;
    EXPECT_NEAR(at(width).b, 0.933f, 0.003f) << width;
    EXPECT_NEAR(at(width).a, 0.25f, 0.01f) << width;
  }
  // Finer than a texel nothing varies, whatever the image has for alpha.
  EXPECT_EQ(at(0.0f).a, 0.0f);
  EXPECT_EQ(at(0.03f).a, 0.0f);
}

TEST(TextureLibrary, TellsHowNormalsVaryAlongAFootprintThatIsLongAndThin) {
  const auto halves = [](int x, int) { return leaning(x < 8 ? 0 : 1, 0); };
  const Scene scene = sceneOf({16, 16}, halves, ofNormals());
  const TextureLibrary library(scene);
  // Eight lookups, each as wide as a texel; four of them in either half.
  const glm::vec4 along = library.sample(*scene.materials[0].baseColorTexture, {0.5f, 0.5f},
                                         {{0.5f, 0.0f}, {0.0f, 0.0625f}, Detail::kFull});
  EXPECT_NEAR(along.a, 0.25f, 0.06f);
  const glm::vec4 across = library.sample(*scene.materials[0].baseColorTexture, {0.25f, 0.5f},
                                          {{0.0f, 0.5f}, {0.0625f, 0.0f}, Detail::kFull});
  EXPECT_NEAR(across.a, 0.0f, 1e-6f);
}

TEST(TextureLibrary, FindsNoVarianceWhereAllNormalsAreAlike) {
  const Scene scene = sceneOf(
      {8, 6}, [](int, int) { return leaning(0, 0); }, ofNormals());
  const TextureLibrary library(scene);
  for (const float width : {0.0f, 0.2f, 0.7f, 2.0f}) {
    EXPECT_NEAR(
        library.sample(*scene.materials[0].baseColorTexture, {0.3f, 0.6f}, TextureFootprint::round(width)).a,
        0.0f, 1e-6f);
  }
}

TEST(SampleWidth, SaysOverHowMuchASampleAverages) {
  // A picture of noise that shines, one texel in a quarter of a sample. The middle one of 3 x 3 finer samples
  // looks at the same point and averages a third as far.
  std::mt19937 random(7);
  Scene scene = sceneOf({64, 64}, [&](int, int) { return grey(static_cast<int>(random() % 256)); });
  scene.materials[0].emission = Rgb(1.0f);
  std::swap(scene.materials[0].baseColorTexture, scene.materials[0].emissionTexture);
  scene.materials[0].baseColor = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
  tests::place(scene, tests::quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 0));
  const Camera camera = tests::lookingAt({0, 0, 2}, {0, 0, 0}, {16, 16}, 0.9);
  const auto rendered = [&](const Camera& seen, float sampleWidth) {
    PathSettings settings;
    settings.pathsPerSample = 1;
    settings.sampleWidth = sampleWidth;
    return combinedRadiance(makePathRenderer(scene, settings)->render(seen, 0));
  };
  const RadianceMap fine = rendered(camera.supersampled(3), 1.0f);
  const RadianceMap narrow = rendered(camera, 1.0f / 3.0f);
  const RadianceMap wide = rendered(camera, 1.0f);
  double difference = 0.0;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const float expected = fine(3 * x + 1, 3 * y + 1).g;
      EXPECT_NEAR(narrow(x, y).g, expected, 2e-3f) << x << " " << y;
      difference += std::abs(wide(x, y).g - expected) / 256.0;
    }
  }
  EXPECT_GT(difference, 0.05);
}

TEST(SampleWidth, IsMoreThanNothing) {
  const Scene scene = sceneOf({1, 1}, [](int, int) { return grey(1); });
  EXPECT_THROW((void)makePathRenderer(scene, {.sampleWidth = 0.0f}), InputError);
}

}  // namespace
}  // namespace promenade::render
