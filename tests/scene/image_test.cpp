// What comes out of image files: channels, alpha, formats told by content.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "src/core/errors.h"
#include "src/scene/load.h"
#include "tests/scene/gltf_files.h"
#include "tests/shared_data.h"

namespace promenade {
namespace {

using nlohmann::json;
using Texel = std::array<std::uint8_t, 4>;

std::string contentOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The triangle with images as base colour textures, one material each, all in use by a primitive.
json texturedScene(const std::vector<std::string>& uris, const char* extension) {
  json document = tests::triangleScene();
  json primitives = json::array();
  for (std::size_t i = 0; i < uris.size(); ++i) {
    document["images"].push_back({{"uri", uris[i]}});
    json texture = {{"source", i}};
    if (extension != nullptr) {
      texture = {{"extensions", {{extension, {{"source", i}}}}}};
    }
    document["textures"].push_back(texture);
    document["materials"].push_back({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", i}}}}}});
    primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"material", i}});
  }
  document["meshes"][0]["primitives"] = primitives;
  return document;
}

TEST(SceneImages, ReadWebpWithAndWithoutAlpha) {
  PROMENADE_NEEDS_SHARED("hostile/khronos-validator/ext/EXT_texture_webp/data/image");
  const auto folder = tests::sharedPath("hostile/khronos-validator/ext/EXT_texture_webp/data/image");
  std::vector<std::string> uris;
  for (const char* name : {"VP8L_red.webp", "VP8_red.webp", "VP8L_red_transparent.webp"}) {
    uris.push_back(tests::dataUri(contentOf(folder / name)));
  }
  const tests::TemporaryFolder files;
  const Scene scene = loadScene(files.write("scene.gltf", texturedScene(uris, "EXT_texture_webp").dump()));
  ASSERT_EQ(scene.images.size(), 3u);
  EXPECT_EQ(scene.images[0].texels(0, 0), (Texel{255, 0, 0, 255}));
  EXPECT_GT(scene.images[1].texels(0, 0)[0], 200);  // lossy
  EXPECT_LT(scene.images[1].texels(0, 0)[1], 50);
  // Not premultiplied: red stays full where alpha is less.
  EXPECT_LT(scene.images[2].texels(0, 0)[3], 255);
  EXPECT_EQ(scene.images[2].texels(0, 0)[0], 255);
}

TEST(SceneImages, KeepColourUnderAlpha) {
  // PNG of one texel, RGBA (200, 100, 50, 128).
  const std::string png =
      "data:image/"
      "png;base64,"
      "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR4nGM4kWLUAAAFNQHfc2Lj2wAAAABJRU5ErkJggg==";
  const tests::TemporaryFolder files;
  const Scene scene = loadScene(files.write("scene.gltf", texturedScene({png}, nullptr).dump()));
  EXPECT_EQ(scene.images.at(0).texels(0, 0), (Texel{200, 100, 50, 128}));
}

TEST(SceneImages, RoundSixteenBitsToEightWithAWarning) {
  // PNG of one grey texel of 16 bits, 0x8080: 32896 / 65535 * 255 = 128.
  const std::string png =
      "data:image/"
      "png;base64,"
      "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABEAAAAABq7kcWAAAAC0lEQVR4nGNoaAAAAYMBARg1IhUAAAAASUVORK5CYII=";
  const tests::TemporaryFolder files;
  const Scene scene = loadScene(files.write("scene.gltf", texturedScene({png}, nullptr).dump()));
  EXPECT_EQ(scene.images.at(0).texels(0, 0), (Texel{128, 128, 128, 255}));
  EXPECT_THAT(scene.warnings, testing::Contains(testing::HasSubstr("16-bit")));
}

TEST(SceneImages, AreDecodedOnceHoweverManyUseThem) {
  const tests::TemporaryFolder files;
  const json document = texturedScene({"texel.png", "./texel.png", "texel.png"}, nullptr);
  PROMENADE_NEEDS_SHARED("scenes/conformance/khronos/Box With Spaces/Normal Map.png");
  files.write("texel.png",
              contentOf(tests::sharedPath("scenes/conformance/khronos/Box With Spaces/Normal Map.png")));
  const Scene scene = loadScene(files.write("scene.gltf", document.dump()));
  EXPECT_EQ(scene.images.size(), 1u);
  EXPECT_EQ(scene.materials.size(), 3u);
}

TEST(SceneImages, ThatNothingUsesAreNotRead) {
  const tests::TemporaryFolder files;
  json document = tests::triangleScene();
  document["images"] = {{{"uri", "absent.png"}}};
  EXPECT_TRUE(loadScene(files.write("scene.gltf", document.dump())).images.empty());
}

}  // namespace
}  // namespace promenade
