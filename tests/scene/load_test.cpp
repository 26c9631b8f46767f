// Small scenes written here, each with one thing to look at or to refuse.

#include "src/scene/load.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <glm/geometric.hpp>

#include "src/core/errors.h"
#include "src/scene/describe.h"
#include "tests/scene/gltf_files.h"

namespace promenade {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;
using tests::addAccessor;
using tests::bytesOf;
using tests::TemporaryFolder;
using tests::triangleScene;

constexpr int kUnsignedByte = 5121;
constexpr int kUnsignedShort = 5123;

constexpr int kFloat = 5126;

Scene loadJson(const json& document, const LoadOptions& options = {}) {
  const TemporaryFolder folder;
  return loadScene(folder.write("scene.gltf", document.dump()), options);
}

/// The message of the refusal.
std::string refusal(const std::filesystem::path& file, const LoadOptions& options = {}) {
  try {
    static_cast<void>(loadScene(file, options));
  } catch (const InputError& error) {
    return error.what();
  }
  return "(it loads)";
}

std::string refusal(const json& document, const LoadOptions& options = {}) {
  const TemporaryFolder folder;
  return refusal(folder.write("scene.gltf", document.dump()), options);
}

TEST(LoadScene, ReadsATriangleFromADataUri) {
  const Scene scene = loadJson(triangleScene());
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].triangles, (std::vector<glm::uvec3>{{0, 1, 2}}));
  EXPECT_EQ(scene.meshes[0].positions[1], glm::vec3(1, 0, 0));
  // Flat normal: (1,0,0) x (0,1,0) = (0,0,1).
  EXPECT_EQ(scene.meshes[0].normals[0], glm::vec3(0, 0, 1));
  ASSERT_EQ(scene.instances.size(), 1u);
  ASSERT_EQ(scene.materials.size(), 1u);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(LoadScene, ComposesTranslationRotationAndScaleDownTheHierarchy) {
  json document = triangleScene();
  // Parent: translate by (10,0,0) and turn a quarter about +Z (x to y); child: scale by 2, then move by
  // (1,0,0). The child's origin is at (1,0,0) turned to (0,1,0), moved to (10,1,0); its x axis is (0,2,0).
  document["nodes"] =
      json::parse(R"([{"translation": [10,0,0], "rotation": [0,0,0.70710678,0.70710678], "children": [1]},
                                      {"mesh": 0, "translation": [1,0,0], "scale": [2,2,2]}])");
  const glm::mat4x3 world = loadJson(document).instances.at(0).worldFromObject;
  EXPECT_LT(glm::distance(world[3], glm::vec3(10, 1, 0)), 1e-5f);
  EXPECT_LT(glm::distance(world[0], glm::vec3(0, 2, 0)), 1e-5f);
}

TEST(LoadScene, SharesOneMeshAmongTheNodesThatShowIt) {
  json document = triangleScene();
  document["nodes"] =
      json::parse(R"([{"mesh": 0}, {"mesh": 0, "translation": [5,0,0]}, {"mesh": 0, "scale": [0,0,0]}])");
  document["scenes"][0]["nodes"] = {0, 1, 2};
  const Scene scene = loadJson(document);
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.instances.size(), 2u);
  EXPECT_THAT(scene.warnings, Contains(HasSubstr("scale of zero")));
}

TEST(LoadScene, MakesTangentsThatPointAlongUAndUp) {
  // u grows with x and v shrinks with y: the image stands upright on the triangle, so T = +X, B = w N x T =
  // +Y, w = 1.
  json document = triangleScene();
  const int texCoords = addAccessor(document, bytesOf<float>({0, 1, 1, 1, 0, 0}), kFloat, "VEC2", 3);
  document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = texCoords;
  document["meshes"][0]["primitives"][0]["material"] = 0;
  document["materials"] = json::parse(R"([{"normalTexture": {"index": 0}}])");
  document["textures"] = json::parse(R"([{"source": 0}])");
  // A PNG of one grey texel.
  document["images"] = json::parse(
      R"([{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg=="}])");
  const Scene scene = loadJson(document);
  ASSERT_EQ(scene.meshes[0].tangents.size(), 3u);
  EXPECT_LT(glm::distance(scene.meshes[0].tangents[0], glm::vec4(1, 0, 0, 1)), 1e-5f);
  ASSERT_EQ(scene.images.size(), 1u);
  EXPECT_EQ(scene.images[0].source->texels()(0, 0), (std::array<std::uint8_t, 4>{128, 128, 128, 255}));
}

TEST(LoadScene, NormalisesIntegerAttributes) {
  json document = triangleScene();
  const int colors = addAccessor(document, bytesOf<std::uint8_t>({255, 0, 51, 255, 0, 0, 0, 0, 0, 0, 0, 0}),
                                 kUnsignedByte, "VEC4", 3);
  document["accessors"].back()["normalized"] = true;
  document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = colors;
  // 255/255, 0, 51/255 = 0.2, 1.
  EXPECT_LT(glm::distance(loadJson(document).meshes[0].colors[0], glm::vec4(1, 0, 0.2f, 1)), 1e-6f);
}

TEST(LoadScene, SkinsMeshesAtRest) {
  // One joint at (0,5,0) binds every vertex; the node of the mesh is elsewhere, which must not matter.
  json document = triangleScene();
  document["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] =
      addAccessor(document, std::string(12, '\0'), kUnsignedByte, "VEC4", 3);
  document["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] =
      addAccessor(document, bytesOf<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}), kFloat, "VEC4", 3);
  document["skins"] = json::parse(R"([{"joints": [1]}])");
  document["nodes"] =
      json::parse(R"([{"mesh": 0, "skin": 0, "translation": [100,0,0]}, {"translation": [0,5,0]}])");
  document["scenes"][0]["nodes"] = {0, 1};
  const Scene scene = loadJson(document);
  const glm::vec3 placed =
      scene.instances.at(0).worldFromObject * glm::vec4(scene.meshes.at(0).positions.at(1), 1.0f);
  EXPECT_EQ(placed, glm::vec3(1, 5, 0));
}

TEST(LoadScene, PutsLightsWhereTheirNodesAre) {
  json document = triangleScene();
  document["extensionsUsed"] = {"KHR_lights_punctual"};
  document["extensions"]["KHR_lights_punctual"] =
      json::parse(R"({"lights": [{"type": "spot", "color": [1,0.5,0], "intensity": 10, "range": 7,
                                  "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.5}}]})");
  // A half turn about +Y: -Z becomes +Z.
  document["nodes"].push_back(json::parse(
      R"({"translation": [1,2,3], "rotation": [0,1,0,0], "extensions": {"KHR_lights_punctual": {"light": 0}}})"));
  document["scenes"][0]["nodes"] = {0, 1};
  const PunctualLight light = loadJson(document).lights.at(0);
  EXPECT_EQ(light.type, PunctualLight::Type::kSpot);
  EXPECT_EQ(light.intensity, Rgb(10, 5, 0));
  EXPECT_EQ(light.position, glm::vec3(1, 2, 3));
  EXPECT_LT(glm::distance(light.direction, glm::vec3(0, 0, 1)), 1e-6f);
  EXPECT_EQ(light.rangeMetres, 7.0f);
  EXPECT_FLOAT_EQ(light.outerConeRadians, 0.5f);
}

TEST(LoadScene, KeepsCameraTracksWithTheChainOfNodes) {
  json document = triangleScene();
  document["cameras"] =
      json::parse(R"([{"type": "perspective", "perspective": {"yfov": 0.9, "znear": 0.1}, "name": "eye"}])");
  document["nodes"] = json::parse(
      R"([{"mesh": 0}, {"name": "rail", "children": [2]}, {"camera": 0, "translation": [0,1,0]}])");
  document["scenes"][0]["nodes"] = {0, 1};
  const int times = addAccessor(document, bytesOf<float>({0, 2}), kFloat, "SCALAR", 2);
  const int values = addAccessor(document, bytesOf<float>({0, 0, 0, 4, 0, 0}), kFloat, "VEC3", 2);
  document["animations"] = {
      {{"name", "walk"},
       {"samplers", {{{"input", times}, {"output", values}, {"interpolation", "STEP"}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}}};
  const Scene scene = loadJson(document);
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_EQ(scene.cameras[0].name, "");
  const CameraAnimation& walk = scene.cameras[1];
  EXPECT_EQ(walk.name, "walk");
  EXPECT_EQ(walk.cameraName, "eye");
  ASSERT_EQ(walk.rootToCamera.size(), 2u);
  ASSERT_TRUE(walk.rootToCamera[0].translationTrack.has_value());
  EXPECT_EQ(walk.rootToCamera[0].translationTrack->interpolation, Interpolation::kStep);
  EXPECT_EQ(walk.rootToCamera[0].translationTrack->times, (std::vector<float>{0, 2}));
  EXPECT_EQ(walk.rootToCamera[0].translationTrack->values[1], glm::vec3(4, 0, 0));
  EXPECT_EQ(walk.rootToCamera[1].translation, glm::dvec3(0, 1, 0));
  EXPECT_FALSE(walk.rootToCamera[1].translationTrack.has_value());
}

TEST(LoadScene, TakesTheFirstSceneWhereNoneIsTheDefault) {
  json document = triangleScene();
  document.erase("scene");
  EXPECT_EQ(loadJson(document).instances.size(), 1u);
  document.erase("scenes");
  EXPECT_EQ(loadJson(document).instances.size(), 1u);
}

TEST(LoadScene, WithoutMeshesLoadsWithANotice) {
  const Scene scene = loadJson(json::parse(R"({"asset": {"version": "2.0"}})"));
  EXPECT_TRUE(scene.instances.empty());
  EXPECT_THAT(scene.warnings, Contains(HasSubstr("no meshes")));
}

TEST(LoadScene, ReadsGlbWithItsBinaryChunk) {
  json document = triangleScene();
  const std::string positions = bytesOf<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});
  document["buffers"][0].erase("uri");
  std::string text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto chunk = [](const std::string& content, std::uint32_t type) {
    return bytesOf<std::uint32_t>({static_cast<std::uint32_t>(content.size()), type}) + content;
  };
  const std::string body = chunk(text, 0x4E4F534A) + chunk(positions, 0x004E4942);
  const std::string header =
      bytesOf<std::uint32_t>({0x46546C67, 2, static_cast<std::uint32_t>(body.size() + 12)});
  const TemporaryFolder folder;
  EXPECT_EQ(loadScene(folder.write("scene.glb", header + body)).meshes.size(), 1u);
  // Every shorter file is refused, or lacks only what it does not need.
  for (std::size_t length = 0; length < header.size() + body.size(); length += 7) {
    const std::string message = refusal(folder.write("cut.glb", (header + body).substr(0, length)));
    EXPECT_THAT(message, HasSubstr("cut.glb")) << length;
  }
}

TEST(EnsureLight, AddsAWhiteSkyOnlyWhereNothingShines) {
  const Scene dark = ensureLight(loadJson(triangleScene()));
  ASSERT_TRUE(dark.environment.has_value());
  EXPECT_EQ(dark.environment->radiance(0, 0), Rgb(1.0f));
  EXPECT_THAT(dark.warnings, Contains(HasSubstr("no light")));
  json document = triangleScene();
  document["materials"] = json::parse(R"([{"emissiveFactor": [1,1,1]}])");
  EXPECT_TRUE(ensureLight(loadJson(document)).environment.has_value());  // the material is not in use
  document["meshes"][0]["primitives"][0]["material"] = 0;
  EXPECT_FALSE(ensureLight(loadJson(document)).environment.has_value());
}

TEST(Describe, CountsWhatIsThere) {
  const std::vector<std::string> lines = describe(loadJson(triangleScene()));
  EXPECT_THAT(lines, Contains(HasSubstr("1 mesh with 1 triangle, 1 instance with 1 triangle")));
  EXPECT_THAT(lines, Contains(HasSubstr("from (0, 0, 0) to (1, 1, 0)")));
}

TEST(RefusedScenes, AbsentFilesFoldersAndPipes) {
  const TemporaryFolder folder;
  EXPECT_THAT(refusal(folder.path() / "absent.gltf"), HasSubstr("absent.gltf: no such file"));
  EXPECT_THAT(refusal(folder.path() / "no" / "such" / "folder.gltf"), HasSubstr("no such file"));
  EXPECT_THAT(refusal(folder.path()), HasSubstr("found a folder"));
  ASSERT_EQ(mkfifo((folder.path() / "pipe.gltf").c_str(), 0600), 0);
  EXPECT_THAT(refusal(folder.path() / "pipe.gltf"), HasSubstr("not a regular file"));
  EXPECT_THAT(refusal(std::filesystem::path("/dev/zero")), HasSubstr("not a regular file"));
}

TEST(RefusedScenes, WhatIsNotGltf) {
  const TemporaryFolder folder;
  EXPECT_THAT(refusal(folder.write("a.gltf", "")), HasSubstr("is not glTF"));
  EXPECT_THAT(refusal(folder.write("b.gltf", "v 0 0 0\nf 1 2 3\n")), HasSubstr("is not glTF"));
  EXPECT_THAT(refusal(folder.write("c.gltf", "[1, 2]")), HasSubstr("expected a JSON object"));
  EXPECT_THAT(refusal(folder.write("d.gltf", "{}")), HasSubstr("asset.version is missing"));
  EXPECT_THAT(refusal(folder.write("e.gltf", std::string("\x89PNG\r\n\x1a\n", 8))), HasSubstr("is not glTF"));
}

TEST(RefusedScenes, DeeplyNestedJson) {
  const TemporaryFolder folder;
  constexpr std::size_t kDepth = 200'000;
  const std::string nested = std::string(kDepth, '[') + std::string(kDepth, ']');
  const std::string message =
      refusal(folder.write("deep.gltf", R"({"asset": {"version": "2.0"}, "extras": )" + nested + "}"));
  EXPECT_THAT(message, HasSubstr("nested more than"));
}

TEST(RefusedScenes, UrisThatLeaveTheFolder) {
  const TemporaryFolder folder;
  const std::string positions = bytesOf<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const std::filesystem::path outside = folder.write("outside.bin", positions);
  folder.write("scene/inside.bin", positions);
  std::filesystem::create_symlink(outside, folder.path() / "scene" / "link.bin");
  json document = triangleScene();
  const auto withUri = [&](const std::string& uri) {
    document["buffers"][0]["uri"] = uri;
    return folder.write("scene/scene.gltf", document.dump());
  };
  for (const std::string& uri :
       {std::string("../outside.bin"), std::string("%2e%2e/outside.bin"), std::string("..%2Foutside.bin"),
        std::string("x/../../outside.bin"), std::string("link.bin"), outside.string()}) {
    EXPECT_THAT(refusal(withUri(uri)), HasSubstr("outside the scene's folder")) << uri;
    LoadOptions anywhere;
    anywhere.fileAccess = FileAccess::kAnywhere;
    if (uri.find("x/") == std::string::npos) {
      EXPECT_EQ(loadScene(withUri(uri), anywhere).meshes.size(), 1u) << uri;
    }
  }
  EXPECT_EQ(loadScene(withUri("inside.bin")).meshes.size(), 1u);
  EXPECT_EQ(loadScene(withUri("x/../inside.bin")).meshes.size(), 1u);
  EXPECT_THAT(refusal(withUri("http://example.com/a.bin")), HasSubstr("only relative file names"));
  EXPECT_THAT(refusal(withUri("file:///etc/passwd")), HasSubstr("only relative file names"));
  EXPECT_THAT(refusal(withUri("absent.bin")), HasSubstr("no such file"));
  EXPECT_THAT(refusal(withUri("a%00b")), HasSubstr("expected a file name"));
}

TEST(RefusedScenes, UrisOfFoldersPipesAndDevices) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "folder");
  ASSERT_EQ(mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
  json document = triangleScene();
  const auto message = [&](const std::string& uri, FileAccess access) {
    document["buffers"][0]["uri"] = uri;
    LoadOptions options;
    options.fileAccess = access;
    return refusal(folder.write("scene.gltf", document.dump()), options);
  };
  EXPECT_THAT(message("folder", FileAccess::kSceneFolder), HasSubstr("found a folder"));
  EXPECT_THAT(message(".", FileAccess::kSceneFolder), HasSubstr("found a folder"));
  EXPECT_THAT(message("pipe", FileAccess::kSceneFolder), HasSubstr("not a regular file"));
  EXPECT_THAT(message("/dev/zero", FileAccess::kAnywhere), HasSubstr("not a regular file"));
  EXPECT_THAT(message("", FileAccess::kSceneFolder), HasSubstr("expected a file name"));
}

TEST(RefusedScenes, HugeCountsInTinyFiles) {
  const auto start = std::chrono::steady_clock::now();
  {
    json document = triangleScene();
    document["accessors"][0]["count"] = 4'000'000'000'000;
    EXPECT_THAT(refusal(document), HasSubstr("do not fit"));
  }
  {
    // Offset and length that wrap around 2^64, were it not for the limit of 2^53.
    json document = triangleScene();
    document["bufferViews"][0]["byteOffset"] = 18'446'744'073'709'551'600ull;
    EXPECT_THAT(refusal(document), HasSubstr("bufferViews[0].byteOffset: expected a non-negative integer"));
    document["bufferViews"][0]["byteOffset"] = 9'007'199'254'740'000;
    EXPECT_THAT(refusal(document), HasSubstr("more than the 36 bytes"));
  }
  {
    // Without a buffer view all elements are zero: nothing in the file bounds their number.
    json document = triangleScene();
    document["accessors"][0].erase("bufferView");
    document["accessors"][0]["count"] = 300'000'000;
    EXPECT_THAT(refusal(document), HasSubstr("--max-expansion"));
    document["accessors"][0]["count"] = 9'000'000'000'000'000;
    EXPECT_THAT(refusal(document), HasSubstr("--max-geometry-bytes"));
  }
  {
    json document = triangleScene();
    document["buffers"][0]["byteLength"] = 1'000'000'000'000;
    EXPECT_THAT(refusal(document), HasSubstr("buffers[0].byteLength"));
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  EXPECT_LT(seconds.count(), 5.0);
}

TEST(RefusedScenes, OneMeshDecodedOverAndOver) {
  // 1.2 MB of positions, once stored, in 2000 primitives of their own.
  json document = triangleScene();
  const int positions = addAccessor(document, std::string(1'200'000, '\0'), kFloat, "VEC3", 100'000);
  json primitives = json::array();
  for (int i = 0; i < 2000; ++i) {
    primitives.push_back({{"attributes", {{"POSITION", positions}}}});
  }
  document["meshes"][0]["primitives"] = primitives;
  EXPECT_THAT(refusal(document), HasSubstr("--max-expansion"));
}

TEST(RefusedScenes, MoreThanTheLimits) {
  LoadOptions few;
  few.maxTriangles = 0;
  EXPECT_THAT(refusal(triangleScene(), few), HasSubstr("--max-triangles"));
  LoadOptions small;
  small.maxJsonBytes = 100;
  EXPECT_THAT(refusal(triangleScene(), small), HasSubstr("--max-json-bytes"));
  LoadOptions tiny;
  tiny.maxFileBytes = 100;
  EXPECT_THAT(refusal(triangleScene(), tiny), HasSubstr("--max-file-bytes"));
  LoadOptions lonely;
  lonely.maxInstances = 0;
  EXPECT_THAT(refusal(triangleScene(), lonely), HasSubstr("--max-instances"));
}

TEST(RefusedScenes, ImagesThatClaimMoreThanTheyHold) {
  // The header of a PNG of 20000 x 20000 texels (1.6 GB decoded), empty data, and its end.
  const std::string magic("\x89PNG\r\n\x1a\n");
  const std::string header("\0\0\0\rIHDR\0\0\x4E\x20\0\0\x4E\x20\x08\x06\0\0\0\xE3\x70\x46\x39", 25);
  const std::string end("\0\0\0\0IDAT\x35\xAF\x06\x1E\0\0\0\0IEND\xAE\x42\x60\x82", 24);
  json document = triangleScene();
  document["meshes"][0]["primitives"][0]["material"] = 0;
  document["materials"] = json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
  document["textures"] = json::parse(R"([{"source": 0}])");
  document["images"] = {{{"uri", tests::dataUri(magic + header + end)}}};
  EXPECT_THAT(refusal(document), HasSubstr("claims 20000 x 20000 texels in 57 bytes"));
  LoadOptions small;
  small.maxTextureBytes = 1'000'000'000;
  EXPECT_THAT(refusal(document, small), HasSubstr("--max-texture-bytes"));
  document["images"][0]["uri"] = tests::dataUri(magic + header);
  EXPECT_THAT(refusal(document), HasSubstr("the PNG is cut off"));
  std::string damaged = magic + header + end;
  damaged[20] = 'x';
  document["images"][0]["uri"] = tests::dataUri(damaged);
  EXPECT_THAT(refusal(document), HasSubstr("the PNG is damaged"));
  document["images"][0]["uri"] = tests::dataUri("no image at all");
  EXPECT_THAT(refusal(document), HasSubstr("expected a PNG, JPEG or WebP image"));
  document["images"][0]["uri"] = "absent.png";
  EXPECT_THAT(refusal(document), HasSubstr("images[0].uri"));
}

TEST(RefusedScenes, CyclesAndSecondParents) {
  json document = triangleScene();
  document["nodes"] = json::parse(R"([{"mesh": 0}, {"children": [2]}, {"children": [1]}])");
  EXPECT_THAT(refusal(document), HasSubstr("nodes[1]: is part of a cycle"));
  document["nodes"] = json::parse(R"([{"children": [0]}])");
  EXPECT_THAT(refusal(document), HasSubstr("its own child"));
  document["nodes"] = json::parse(R"([{"children": [2]}, {"children": [2]}, {"mesh": 0}])");
  EXPECT_THAT(refusal(document), HasSubstr("more than one parent"));
}

TEST(RefusedScenes, IndicesOutOfRange) {
  json document = triangleScene();
  document["meshes"][0]["primitives"][0]["indices"] =
      addAccessor(document, bytesOf<std::uint16_t>({0, 1, 3}), kUnsignedShort, "SCALAR", 3);
  EXPECT_THAT(refusal(document), HasSubstr("there is no vertex 3, POSITION has 3"));
  document = triangleScene();
  document["nodes"][0]["mesh"] = 4'294'967'296;  // 0, cut to 32 bits
  EXPECT_THAT(refusal(document), HasSubstr("nodes[0].mesh: expected an index"));
  document["nodes"][0]["mesh"] = -1;
  EXPECT_THAT(refusal(document), HasSubstr("nodes[0].mesh: expected an index, found -1"));
  document["nodes"][0]["mesh"] = 1;
  EXPECT_THAT(refusal(document), HasSubstr("nodes[0].mesh: found 1, but the file has 1 meshes"));
  document["nodes"][0]["mesh"] = "0";
  EXPECT_THAT(refusal(document), HasSubstr("nodes[0].mesh: expected an index, found \"0\""));
}

TEST(RefusedScenes, CoordinatesThatAreNotFinite) {
  json document = triangleScene();
  const float inf = std::numeric_limits<float>::infinity();
  document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
      addAccessor(document, bytesOf<float>({0, 0, 0, 1, inf, 0, 0, 1, 0}), kFloat, "VEC3", 3);
  EXPECT_THAT(refusal(document), HasSubstr("not finite"));
  document = triangleScene();
  document["nodes"][0]["translation"] = {1e300, 0, 0};
  EXPECT_THAT(refusal(document), HasSubstr("nodes[0]"));
}

TEST(RefusedScenes, RequiredExtensionsThatAreUnknown) {
  json document = triangleScene();
  document["extensionsRequired"] = {"ACME_hologram"};
  EXPECT_THAT(refusal(document),
              HasSubstr("requires the extension \"ACME_hologram\", which is not supported"));
  document.erase("extensionsRequired");
  document["extensionsUsed"] = {"ACME_hologram", "ACME_hologram"};
  const Scene scene = loadJson(document);
  EXPECT_EQ(scene.warnings.size(), 1u);
}

TEST(RefusedScenes, TracksWhoseSizesDoNotMatch) {
  json document = triangleScene();
  document["cameras"] =
      json::parse(R"([{"type": "perspective", "perspective": {"yfov": 0.9, "znear": 0.1}}])");
  document["nodes"][0]["camera"] = 0;
  const int times = addAccessor(document, bytesOf<float>({0, 1, 2}), kFloat, "SCALAR", 3);
  const int values = addAccessor(document, bytesOf<float>({0, 0, 0, 4, 0, 0}), kFloat, "VEC3", 2);
  document["animations"] = {
      {{"samplers", {{{"input", times}, {"output", values}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
  EXPECT_THAT(refusal(document), HasSubstr("3 times need 3 values, found 2"));
}

TEST(LargeScenes, OfAMillionNodesLoad) {
  std::string text = triangleScene().dump();
  std::string nodes = "[{\"mesh\":0}";
  std::string roots = "[0";
  for (int i = 1; i < 1'000'000; ++i) {
    nodes.append(R"(,{"mesh":0,"translation":[)").append(std::to_string(i % 1000)).append(",0,");
    nodes.append(std::to_string(i / 1000)).append("]}");
    roots.append(",").append(std::to_string(i));
  }
  json document = triangleScene();
  document.erase("nodes");
  document.erase("scenes");
  text = document.dump();
  text.pop_back();
  text.append(R"(,"nodes":)").append(nodes).append(R"(],"scenes":[{"nodes":)").append(roots).append("]}]}");
  const TemporaryFolder folder;
  const auto file = folder.write("many.gltf", text);
  const auto start = std::chrono::steady_clock::now();
  const Scene scene = loadScene(file);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(scene.instances.size(), 1'000'000u);
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_LT(seconds.count(), 60.0);
}

TEST(LargeScenes, OfAChainOfAHundredThousandNodesLoad) {
  json document = triangleScene();
  json nodes = json::array();
  constexpr int kCount = 100'000;
  for (int i = 0; i + 1 < kCount; ++i) {
    nodes.push_back({{"children", {i + 1}}});
  }
  nodes.push_back({{"mesh", 0}});
  document["nodes"] = nodes;
  EXPECT_EQ(loadJson(document).instances.size(), 1u);
}

TEST(LargeScenes, OfManyNodesThatShareAMeshOfManyPointsLoadQuickly) {
  // 20,000 nodes x 20,000 primitives without triangles: 400 million pairs, none of which is looked at.
  json document = triangleScene();
  document["meshes"][0]["primitives"] = json::array();
  document["nodes"] = json::array();
  document.erase("scenes");
  document.erase("scene");
  for (int i = 0; i < 20'000; ++i) {
    document["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 0}});
    document["nodes"].push_back({{"mesh", 0}});
  }
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(loadJson(document).instances.empty());
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  EXPECT_LT(seconds.count(), 10.0);
}

TEST(LargeScenes, InstancesByTheBillionAreRefused) {
  // 100 primitives of one triangle in each of 100,000 nodes: 10 million instances of 2 MB of JSON.
  json document = triangleScene();
  document["meshes"][0]["primitives"] = json::array();
  for (int i = 0; i < 100; ++i) {
    document["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}});
  }
  document["nodes"] = json::array();
  document["scenes"][0]["nodes"] = json::array();
  for (int i = 0; i < 100'000; ++i) {
    document["nodes"].push_back({{"mesh", 0}});
    document["scenes"][0]["nodes"].push_back(i);
  }
  EXPECT_THAT(refusal(document), HasSubstr("--max-expansion"));
  LoadOptions patient;
  patient.maxExpansion = 1'000'000;
  EXPECT_THAT(refusal(document, patient), HasSubstr("--max-instances"));
}

}  // namespace
}  // namespace promenade
