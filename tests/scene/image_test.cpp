// What comes out of image files: channels, alpha, formats told by content.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <numeric>

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

/// PNG of one texel, RGBA (200, 100, 50, 128): signature, header, data, end.
const std::string kTexelPng(
    "\x89PNG\x0d\x0a\x1a\x0a"
    "\x00\x00\x00\x0dIHDR\x00\x00\x00\x01\x00\x00\x00\x01\x08\x06\x00\x00\x00\x1f\x15\xc4\x89"
    "\x00\x00\x00\x0dIDATx\x9c"
    "c8\x91"
    "b\xd4\x00\x00\x05"
    "5\x01\xdfsb\xe3\xdb"
    "\x00\x00\x00\x00IEND\xae"
    "B`\x82",
    70);

Texel firstTexel(const TextureImage& image) {
  return image.source->texels()(0, 0);
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
  EXPECT_EQ(firstTexel(scene.images[0]), (Texel{255, 0, 0, 255}));
  EXPECT_GT(firstTexel(scene.images[1])[0], 200);  // lossy
  EXPECT_LT(firstTexel(scene.images[1])[1], 50);
  // Not premultiplied: red stays full where alpha is less.
  EXPECT_LT(firstTexel(scene.images[2])[3], 255);
  EXPECT_EQ(firstTexel(scene.images[2])[0], 255);
}

TEST(SceneImages, KeepColourUnderAlpha) {
  const tests::TemporaryFolder files;
  const Scene scene =
      loadScene(files.write("scene.gltf", texturedScene({tests::dataUri(kTexelPng)}, nullptr).dump()));
  EXPECT_EQ(firstTexel(scene.images.at(0)), (Texel{200, 100, 50, 128}));
}

TEST(SceneImages, SayHowOftenEachValueOccurs) {
  const tests::TemporaryFolder files;
  const Scene scene =
      loadScene(files.write("scene.gltf", texturedScene({tests::dataUri(kTexelPng)}, nullptr).dump()));
  const TextureImage& image = scene.images.at(0);
  EXPECT_EQ(image.size, (Size{1, 1}));
  const Texel texel{200, 100, 50, 128};
  for (std::size_t c = 0; c < 4; ++c) {
    EXPECT_EQ(image.counts[c][texel[c]], 1u);
    EXPECT_EQ(std::accumulate(image.counts[c].begin(), image.counts[c].end(), std::uint64_t{0}), 1u);
  }
}

TEST(SceneImages, KeepOnlyTheEncodedBytesOfABuffersImage) {
  const tests::TemporaryFolder files;
  json document = texturedScene({"unused"}, nullptr);
  files.write("image.bin", std::string(1000, 'x') + kTexelPng + std::string(3000, 'x'));
  document["buffers"].push_back({{"uri", "image.bin"}, {"byteLength", 4000 + kTexelPng.size()}});
  document["bufferViews"].push_back(
      {{"buffer", document["buffers"].size() - 1}, {"byteOffset", 1000}, {"byteLength", kTexelPng.size()}});
  document["images"][0] = {{"bufferView", document["bufferViews"].size() - 1}, {"mimeType", "image/png"}};
  const Scene scene = loadScene(files.write("scene.gltf", document.dump()));
  EXPECT_EQ(scene.images.at(0).source->bytes().size(), kTexelPng.size());
  EXPECT_EQ(firstTexel(scene.images[0]), (Texel{200, 100, 50, 128}));
}

TEST(SceneImages, RoundSixteenBitsToEightWithAWarning) {
  // PNG of one grey texel of 16 bits, 0x8080: 32896 / 65535 * 255 = 128.
  const std::string png =
      "data:image/"
      "png;base64,"
      "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABEAAAAABq7kcWAAAAC0lEQVR4nGNoaAAAAYMBARg1IhUAAAAASUVORK5CYII=";
  const tests::TemporaryFolder files;
  const Scene scene = loadScene(files.write("scene.gltf", texturedScene({png}, nullptr).dump()));
  EXPECT_EQ(firstTexel(scene.images.at(0)), (Texel{128, 128, 128, 255}));
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
