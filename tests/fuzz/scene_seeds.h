#pragma once
// Small scenes that use every part of the loader, to be mutated.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/scene/gltf_files.h"

namespace promenade::tests {

/// One texel.
inline std::string tinyPng() {
  return "data:image/png;base64,"
         "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg==";
}

/// Indices, all attributes, sparse data, morph targets, a skin, instancing, a camera with an animation, a
/// light, a material with all extensions.
inline nlohmann::json richScene() {
  using nlohmann::json;
  constexpr int kByte = 5121;
  constexpr int kShort = 5123;
  constexpr int kFloat = 5126;
  json scene = triangleScene();
  json& primitive = scene["meshes"][0]["primitives"][0];
  const auto floats = [&](const std::vector<float>& values, const char* type, std::size_t count) {
    return addAccessor(scene, bytesOf(values), kFloat, type, count);
  };
  primitive["indices"] = addAccessor(scene, bytesOf<std::uint16_t>({0, 1, 2}), kShort, "SCALAR", 3);
  primitive["attributes"]["NORMAL"] = floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
  primitive["attributes"]["TEXCOORD_0"] = floats({0, 1, 1, 1, 0, 0}, "VEC2", 3);
  primitive["attributes"]["COLOR_0"] = floats({1, 1, 1, 1, 1, 1, 1, 1, 1}, "VEC3", 3);
  primitive["targets"] = {{{"POSITION", floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3)}}};
  scene["meshes"][0]["weights"] = {0.5};
  const int sparseIndices = addView(scene, bytesOf<std::uint16_t>({1}));
  const int sparseValues = addView(scene, bytesOf<float>({2, 0, 0}));
  scene["accessors"][0]["sparse"] = {{"count", 1},
                                     {"indices", {{"bufferView", sparseIndices}, {"componentType", kShort}}},
                                     {"values", {{"bufferView", sparseValues}}}};
  json skinned = primitive;
  skinned["attributes"]["JOINTS_0"] = addAccessor(scene, std::string(12, '\0'), kByte, "VEC4", 3);
  skinned["attributes"]["WEIGHTS_0"] = floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 3);
  scene["meshes"].push_back({{"primitives", {skinned}}});
  const int identity = floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "MAT4", 1);
  scene["skins"] = {{{"joints", {2}}, {"inverseBindMatrices", identity}}};
  const int places = floats({0, 0, 0, 5, 0, 0}, "VEC3", 2);
  const int times = floats({0, 1}, "SCALAR", 2);
  scene["meshes"][0]["primitives"][0]["material"] = 0;
  scene["images"] = {{{"uri", tinyPng()}}};
  scene["samplers"] = {{{"wrapS", 33071}, {"minFilter", 9728}}};
  scene["textures"] = {{{"source", 0}, {"sampler", 0}}};
  scene["materials"] = json::parse(R"([{
      "pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0, 1], "baseColorTexture": {"index": 0, "extensions":
          {"KHR_texture_transform": {"offset": [0, 1], "rotation": 1, "scale": [2, 2]}}}, "metallicFactor": 0.5},
      "normalTexture": {"index": 0, "scale": 2}, "emissiveFactor": [1, 1, 1], "alphaMode": "MASK", "alphaCutoff": 0.3,
      "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 3}, "KHR_materials_ior": {"ior": 1.4},
          "KHR_materials_transmission": {"transmissionFactor": 1, "transmissionTexture": {"index": 0}},
          "KHR_materials_volume": {"attenuationDistance": 2, "attenuationColor": [1, 0.5, 0.5]},
          "KHR_materials_specular": {"specularColorFactor": [1, 1, 1]}, "KHR_materials_clearcoat": {"clearcoatFactor": 1}}}])");
  scene["cameras"] = json::parse(R"([{"type": "perspective", "perspective": {"yfov": 0.9, "znear": 0.1}}])");
  scene["extensions"] =
      json::parse(R"({"KHR_lights_punctual": {"lights": [{"type": "spot", "color": [1, 1, 1],
      "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.2}}]}})");
  scene["nodes"] =
      json::parse(R"([{"mesh": 0, "children": [1, 2], "rotation": [0, 0, 0, 1]}, {"mesh": 1, "skin": 0},
      {"camera": 0, "translation": [0, 0, 5], "extensions": {"KHR_lights_punctual": {"light": 0}}}])");
  scene["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = places;
  scene["animations"] = {
      {{"samplers", {{{"input", times}, {"output", places}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "translation"}}}}}}}};
  scene["extensionsUsed"] = {"KHR_lights_punctual", "EXT_mesh_gpu_instancing"};
  return scene;
}

/// The document as GLB, its buffers still in data URIs.
inline std::string asGlb(const nlohmann::json& document) {
  std::string text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto size = static_cast<std::uint32_t>(text.size());
  return bytesOf<std::uint32_t>({0x46546C67, 2, size + 20, size, 0x4E4F534A}).append(text);
}

}  // namespace promenade::tests
