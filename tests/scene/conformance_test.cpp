// Files that well-behaved loaders must read.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <set>

#include "src/core/errors.h"
#include "src/scene/describe.h"
#include "src/scene/load.h"
#include "tests/scene/conformance_table.h"
#include "tests/shared_data.h"

namespace promenade {
namespace {

using testing::Contains;
using testing::HasSubstr;

std::filesystem::path conformance(const std::string& file) {
  return tests::sharedPath("scenes/conformance") / file;
}

Scene loadConformance(const std::string& file) {
  return loadScene(conformance(file));
}

TEST(ConformanceScenes, GiveTheTrianglesOfTheirFilesOrAreRefusedByName) {
  PROMENADE_NEEDS_SHARED("scenes/conformance");
  for (const tests::Conformance& expected : tests::kConformance) {
    SCOPED_TRACE(expected.file);
    try {
      const Scene scene = loadConformance(std::string(expected.file));
      EXPECT_EQ(expected.refusal, "");
      const SceneSummary summary = summarize(scene);
      EXPECT_EQ(summary.placedTriangles, expected.placedTriangles);
      EXPECT_EQ(summary.instances, expected.instances);
    } catch (const InputError& error) {
      EXPECT_NE(expected.refusal, "") << error.what();
      EXPECT_THAT(error.what(), HasSubstr(std::string(expected.refusal)));
    }
  }
}

TEST(ConformanceScenes, AreAllInTheTable) {
  PROMENADE_NEEDS_SHARED("scenes/conformance");
  std::set<std::string> known;
  for (const tests::Conformance& expected : tests::kConformance) {
    known.insert(std::string(expected.file));
  }
  for (const auto& entry : std::filesystem::recursive_directory_iterator(conformance(""))) {
    const std::string ending = entry.path().extension().string();
    if (ending == ".gltf" || ending == ".glb") {
      EXPECT_THAT(known, Contains(std::filesystem::relative(entry.path(), conformance("")).string()));
    }
  }
}

TEST(ConformanceScenes, KeepEveryPromiseOfScene) {
  PROMENADE_NEEDS_SHARED("scenes/conformance");
  for (const tests::Conformance& expected : tests::kConformance) {
    if (!expected.refusal.empty()) {
      continue;
    }
    SCOPED_TRACE(expected.file);
    const Scene scene = loadConformance(std::string(expected.file));
    ASSERT_FALSE(scene.materials.empty());
    for (const Instance& instance : scene.instances) {
      ASSERT_LT(static_cast<std::size_t>(instance.mesh), scene.meshes.size());
      ASSERT_NE(glm::determinant(glm::mat3(instance.worldFromObject)), 0.0f);
    }
    for (const Mesh& mesh : scene.meshes) {
      const std::size_t count = mesh.positions.size();
      ASSERT_LT(static_cast<std::size_t>(mesh.material), scene.materials.size());
      ASSERT_EQ(mesh.normals.size(), count);
      ASSERT_TRUE(mesh.tangents.empty() || mesh.tangents.size() == count);
      ASSERT_TRUE(mesh.colors.empty() || mesh.colors.size() == count);
      for (const auto& texCoords : mesh.texCoords) {
        ASSERT_TRUE(texCoords.empty() || texCoords.size() == count);
      }
      for (const glm::uvec3& triangle : mesh.triangles) {
        ASSERT_LT(std::max({triangle.x, triangle.y, triangle.z}), count);
      }
      for (const glm::vec3& normal : mesh.normals) {
        ASSERT_NEAR(glm::length(normal), 1.0f, 1e-5f);
      }
      for (const glm::vec4& tangent : mesh.tangents) {
        ASSERT_NEAR(glm::length(glm::vec3(tangent)), 1.0f, 1e-5f);
        ASSERT_EQ(std::abs(tangent.w), 1.0f);
      }
    }
    for (const Material& material : scene.materials) {
      for (const auto* texture : {&material.baseColorTexture, &material.metallicRoughnessTexture,
                                  &material.normalTexture, &material.emissionTexture}) {
        if (*texture) {
          ASSERT_GE((*texture)->image, 0);
          ASSERT_LT(static_cast<std::size_t>((*texture)->image), scene.images.size());
        }
      }
    }
  }
}

TEST(ConformanceScenes, WithStripsAndFansFaceTheWayOfTheirTriangles) {
  PROMENADE_NEEDS_SHARED("scenes/conformance");
  // A hexagon in the plane z = 0, as TRIANGLES, TRIANGLE_STRIP and TRIANGLE_FAN; every triangle winds the
  // same way.
  const Scene scene = loadConformance("khronos/MeshPrimitiveModes/MeshPrimitiveModes.gltf");
  ASSERT_EQ(scene.meshes.size(), 3u);
  for (const Mesh& mesh : scene.meshes) {
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::vec3 normal =
          glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
      EXPECT_GT(normal.z, 0.0f) << mesh.name;
    }
  }
  EXPECT_THAT(scene.warnings, Contains(HasSubstr("points and lines")));
}

TEST(ConformanceScenes, WithSparseAccessorsGetTheSubstitutedPositions) {
  PROMENADE_NEEDS_SHARED("scenes/conformance");
  // Without normals, so vertices are unshared: look for the three substituted points among all (README of the
  // sample: vertices 8, 10, 12 move to (1,2,0), (3,3,0), (5,4,0)).
  const Scene scene = loadConformance("khronos/SimpleSparseAccessor/SimpleSparseAccessor.gltf");
  ASSERT_EQ(scene.meshes.size(), 1u);
  for (const glm::vec3 expected : {glm::vec3(1, 2, 0), glm::vec3(3, 3, 0), glm::vec3(5, 4, 0)}) {
    EXPECT_THAT(scene.meshes[0].positions, Contains(expected));
  }
}

TEST(ConformanceScenes, GiveTheSameVertexColoursForEveryComponentType) {
  PROMENADE_NEEDS_SHARED("scenes/conformance");
  // 00: three floats; 01, 02: bytes, shorts; 03 to 05 the same with alpha. Bytes round to 1/255.
  const auto colors = [](int number) {
    const Scene scene =
        loadConformance("asset-generator/Mesh_PrimitiveVertexColor/Mesh_PrimitiveVertexColor_0" +
                        std::to_string(number) + ".gltf");
    return scene.meshes.at(0).colors;
  };
  const auto expected = colors(0);
  ASSERT_FALSE(expected.empty());
  EXPECT_NE(expected[0], expected[1]);
  for (int number = 1; number < 6; ++number) {
    const auto found = colors(number);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(found[i][c], expected[i][c], 1.0f / 255.0f) << number;
      }
    }
  }
}

TEST(ConformanceScenes, GiveTheSamePlaneForEveryInterleavedLayout) {
  PROMENADE_NEEDS_SHARED("scenes/conformance");
  const auto load = [](int number) {
    return loadConformance("asset-generator/Buffer_Interleaved/Buffer_Interleaved_0" +
                           std::to_string(number) + ".gltf");
  };
  const Scene expected = load(0);
  for (int number = 1; number < 5; ++number) {
    const Scene found = load(number);
    EXPECT_EQ(found.meshes[0].positions, expected.meshes[0].positions) << number;
    ASSERT_EQ(found.meshes[0].texCoords[0].size(), expected.meshes[0].texCoords[0].size()) << number;
    for (std::size_t i = 0; i < found.meshes[0].texCoords[0].size(); ++i) {
      EXPECT_LT(glm::distance(found.meshes[0].texCoords[0][i], expected.meshes[0].texCoords[0][i]), 0.01f)
          << number;
    }
  }
}

TEST(ConformanceScenes, ReadSamplersAsTheirReadmeSays) {
  PROMENADE_NEEDS_SHARED("scenes/conformance");
  const auto sampler = [](const std::string& number) {
    const Scene scene =
        loadConformance("asset-generator/Texture_Sampler/Texture_Sampler_" + number + ".gltf");
    return *scene.materials.at(0).baseColorTexture;
  };
  EXPECT_EQ(sampler("00").wrapU, Wrap::kRepeat);
  EXPECT_TRUE(sampler("00").mipmapped);
  EXPECT_EQ(sampler("01").wrapV, Wrap::kClampToEdge);
  EXPECT_EQ(sampler("01").wrapU, Wrap::kRepeat);
  EXPECT_EQ(sampler("04").wrapU, Wrap::kMirroredRepeat);
  EXPECT_EQ(sampler("05").magnification, Filter::kNearest);
  EXPECT_EQ(sampler("06").magnification, Filter::kLinear);
  EXPECT_FALSE(sampler("08").mipmapped);
  EXPECT_TRUE(sampler("12").mipmapped);
}

TEST(ConformanceScenes, RotateTexturesAsKhrTextureTransformShowsThem) {
  PROMENADE_NEEDS_SHARED("scenes/conformance");
  // The quad spans [-0.5, 0.5] with v downwards. The arrow of the image ends where the marker "not supported"
  // sits, (0.2778, -0.2778): uv (0.7778, 0.7778). Transformed it must be seen at the marker "correct",
  // (-0.0790, -0.5163): uv (0.4210, 1.0163) must be mapped to (0.7778, 0.7778).
  const Scene scene = loadConformance("khronos/TextureTransformTest/TextureTransformTest.gltf");
  for (const Material& material : scene.materials) {
    if (material.name == "Rotation") {
      const glm::vec3 uv = material.baseColorTexture->transform * glm::vec3(0.4210f, 1.0163f, 1.0f);
      EXPECT_NEAR(uv.x, 0.7778f, 1e-3f);
      EXPECT_NEAR(uv.y, 0.7778f, 1e-3f);
      return;
    }
  }
  FAIL() << "there is no material named Rotation";
}

TEST(ConformanceScenes, WithSpacesAndUnicodeInUrisFindTheirFiles) {
  PROMENADE_NEEDS_SHARED("scenes/conformance");
  EXPECT_EQ(loadConformance("khronos/Box With Spaces/Box With Spaces.gltf").images.size(), 3u);
  EXPECT_EQ(loadConformance("khronos/Unicode❤♻Test/Unicode❤♻Test.gltf").images.size(), 1u);
}

TEST(ConformanceScenes, ExpandInstancing) {
  PROMENADE_NEEDS_SHARED("scenes/conformance");
  const Scene scene = loadConformance("khronos/SimpleInstancing/SimpleInstancing.gltf");
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.instances.size(), 125u);  // 5 x 5 x 5
  EXPECT_NE(scene.instances.front().worldFromObject, scene.instances.back().worldFromObject);
}

TEST(ConformanceScenes, ShowMorphTargetsWithTheirDefaultWeights) {
  PROMENADE_NEEDS_SHARED("scenes/conformance");
  // Weights 0.5, 0.5; base vertex (0.5, 0.5, 0), displacements (-1, 1, 0) and (1, 1, 0): (0.5, 1.5, 0).
  const Scene scene = loadConformance("khronos/SimpleMorph/SimpleMorph.gltf");
  EXPECT_THAT(scene.meshes.at(0).positions, Contains(glm::vec3(0.5f, 1.5f, 0.0f)));
  EXPECT_THAT(scene.warnings, Contains(HasSubstr("morph targets")));
}

TEST(ConformanceScenes, MirrorInstancesWithoutTurningThemInsideOut) {
  PROMENADE_NEEDS_SHARED("scenes/conformance");
  const Scene scene = loadConformance("khronos/NegativeScaleTest/NegativeScaleTest.gltf");
  int mirrored = 0;
  for (const Instance& instance : scene.instances) {
    mirrored += glm::determinant(glm::mat3(instance.worldFromObject)) < 0.0f ? 1 : 0;
  }
  // The file's names say which: NegativeScaleFront, NotShinyMinus1, and of the two parents that mirror
  // themselves (Shiny, Dark) the children that do not: Shiny1, Dark1.
  EXPECT_EQ(mirrored, 4);
}

TEST(ConformanceScenes, ReadMaterialExtensions) {
  PROMENADE_NEEDS_SHARED("scenes/conformance");
  const Scene emissive = loadConformance("khronos/EmissiveStrengthTest/EmissiveStrengthTest.gltf");
  // Factor (0.1, 0.5, 0.9), strength 4.
  EXPECT_NEAR(emissive.materials.at(0).emission.y, 2.0f, 1e-5f);
  const Scene attenuation = loadConformance("khronos/AttenuationTest/AttenuationTest.gltf");
  EXPECT_EQ(attenuation.materials.at(0).transmission, 1.0f);
  EXPECT_EQ(attenuation.materials.at(0).attenuationDistanceMetres, 1.0f);
  EXPECT_EQ(attenuation.materials.at(0).attenuationColor, Rgb(0.1f, 0.5f, 0.9f));
  const Scene unlit = loadConformance("khronos/UnlitTest/UnlitTest.gltf");
  EXPECT_TRUE(unlit.materials.at(0).unlit);
}

TEST(ConformanceScenes, ReadPerspectiveCamerasAndNameTheOthers) {
  PROMENADE_NEEDS_SHARED("scenes/conformance");
  const Scene scene = loadConformance("khronos/Cameras/Cameras.gltf");
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.cameras[0].verticalFieldOfView, 0.7);
  ASSERT_EQ(scene.cameras[0].rootToCamera.size(), 1u);
  EXPECT_EQ(scene.cameras[0].rootToCamera[0].translation, glm::dvec3(0.5, 0.5, 3.0));
  EXPECT_THAT(scene.warnings, Contains(HasSubstr("only perspective cameras")));
}

TEST(RealScenes, LoadWithTheirWalks) {
  PROMENADE_NEEDS_SHARED("scenes/sponza-256");
  const Scene sponza = loadScene(tests::sharedPath("scenes/sponza-256/Sponza_walk.gltf"));
  EXPECT_EQ(summarize(sponza).placedTriangles, 262267u);  // 262k (README of the scenes)
  ASSERT_FALSE(sponza.cameras.empty());
  EXPECT_EQ(sponza.cameras.back().name, "walk");
  EXPECT_FALSE(hasLight(sponza));
  const Scene kitchen = loadScene(tests::sharedPath("scenes/country-kitchen/kitchen_walk.gltf"));
  EXPECT_GT(summarize(kitchen).placedTriangles, 1'000'000u);
  EXPECT_TRUE(hasLight(kitchen));
  const Scene tokyo = loadScene(tests::sharedPath("scenes/littlest-tokyo/littlest-tokyo.gltf"));
  EXPECT_EQ(summarize(tokyo).placedTriangles, 141802u);
  const Scene city = loadScene(tests::sharedPath("scenes/virtual-city/VC.gltf"));
  EXPECT_EQ(summarize(city).cameraAnimations, 14u);
  const Scene teapots = loadScene(tests::sharedPath("scenes/teapots-instanced/TeapotsGalore.gltf"));
  EXPECT_EQ(summarize(teapots).placedTriangles, 7'656'770u);
}

}  // namespace
}  // namespace promenade
