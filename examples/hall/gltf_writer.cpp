#include "examples/hall/gltf_writer.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace promenade::hall {
namespace {

using Json = nlohmann::ordered_json;

// glTF 2.0 enumerants.
constexpr int kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr int kLinear = 9729, kLinearMipmapLinear = 9987, kRepeat = 10497;

template <class Vector>
Json jsonOf(const Vector& v) {
  Json array = Json::array();
  for (int k = 0; k < v.length(); ++k) array.push_back(v[k]);
  return array;
}

/// The components one after the other, as floats.
template <class Vector>
std::vector<float> flattened(const std::vector<Vector>& values) {
  std::vector<float> floats;
  floats.reserve(values.size() * static_cast<std::size_t>(Vector::length()));
  for (const Vector& v : values) {
    for (int k = 0; k < Vector::length(); ++k) floats.push_back(static_cast<float>(v[k]));
  }
  return floats;
}

/// Smallest and largest of each component.
std::pair<Json, Json> bounds(const std::vector<float>& floats, std::size_t components) {
  std::vector<float> low(components, std::numeric_limits<float>::max()),
      high(components, std::numeric_limits<float>::lowest());
  for (std::size_t i = 0; i < floats.size(); ++i) {
    low[i % components] = std::min(low[i % components], floats[i]);
    high[i % components] = std::max(high[i % components], floats[i]);
  }
  return {Json(low), Json(high)};
}

/// Indices of the triangles that have an area; those at a pole have none.
std::vector<std::uint32_t> withoutDegenerates(const Surface& surface) {
  std::vector<std::uint32_t> kept;
  kept.reserve(surface.indices.size());
  for (std::size_t i = 0; i < surface.indices.size(); i += 3) {
    const glm::dvec3 a = surface.positions[surface.indices[i]], b = surface.positions[surface.indices[i + 1]],
                     c = surface.positions[surface.indices[i + 2]];
    if (glm::length(glm::cross(b - a, c - a)) > 1e-12)
      kept.insert(kept.end(), {surface.indices[i], surface.indices[i + 1], surface.indices[i + 2]});
  }
  return kept;
}

void writePng(const std::filesystem::path& file, const Picture& picture) {
  const auto output = OIIO::ImageOutput::create("png");
  if (output) output->threads(1);  // small pictures: threads would cost more than they give
  OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("png:compressionLevel", 6);
  if (!output || !output->open(file.string(), spec) ||
      !output->write_image(OIIO::TypeDesc::UINT8, picture.rgb.data()) || !output->close()) {
    throw std::runtime_error(file.string() +
                             ": cannot be written: " + (output ? output->geterror() : OIIO::geterror()));
  }
}

void writeBytes(const std::filesystem::path& file, const char* data, std::size_t size) {
  std::ofstream stream(file, std::ios::binary);
  stream.write(data, static_cast<std::streamsize>(size));
  stream.close();
  if (!stream) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace

struct GltfWriter::Document {
  Json json = {
      {"asset", {{"version", "2.0"}, {"generator", "Promenade make_hall"}, {"copyright", "MIT licence"}}},
      {"extensionsUsed", Json::array()},
      {"scene", 0},
      {"scenes", {{{"name", "hall"}, {"nodes", Json::array()}}}},
      {"nodes", Json::array()},
      {"meshes", Json::array()},
      {"materials", Json::array()},
      {"accessors", Json::array()},
      {"bufferViews", Json::array()}};

  void use(const char* extension) {
    Json& used = json["extensionsUsed"];
    if (std::find(used.begin(), used.end(), extension) == used.end()) used.push_back(extension);
  }

  void addRoot(Json node) {
    json["scenes"][0]["nodes"].push_back(json["nodes"].size());
    json["nodes"].push_back(std::move(node));
  }
};

GltfWriter::GltfWriter() : document_(std::make_unique<Document>()) {}
GltfWriter::~GltfWriter() = default;

ImageId GltfWriter::addImage(const std::string& name, Picture picture) {
  Json& json = document_->json;
  if (!json.contains("samplers")) {
    json["samplers"] = {
        {{"magFilter", kLinear}, {"minFilter", kLinearMipmapLinear}, {"wrapS", kRepeat}, {"wrapT", kRepeat}}};
    json["textures"] = Json::array();
    json["images"] = Json::array();
  }
  json["textures"].push_back({{"sampler", 0}, {"source", json["images"].size()}});
  json["images"].push_back({{"name", name}, {"uri", name + ".png"}});
  pictures_.push_back({name + ".png", std::move(picture)});
  return static_cast<ImageId>(pictures_.size() - 1);
}

MaterialId GltfWriter::addMaterial(const MaterialSpec& spec) {
  Json pbr = {{"baseColorFactor", {spec.baseColor.x, spec.baseColor.y, spec.baseColor.z, 1.0}}};
  if (spec.baseColorImage) pbr["baseColorTexture"] = {{"index", static_cast<int>(*spec.baseColorImage)}};
  pbr["metallicFactor"] = spec.metallic;
  pbr["roughnessFactor"] = spec.roughness;
  Json material = {{"name", spec.name}, {"pbrMetallicRoughness", pbr}};
  if (spec.normalImage) material["normalTexture"] = {{"index", static_cast<int>(*spec.normalImage)}};
  const double strength = std::max({spec.emission.x, spec.emission.y, spec.emission.z});
  if (strength > 0.0) {
    material["emissiveFactor"] = jsonOf(spec.emission / strength);
    material["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", strength}};
    document_->use("KHR_materials_emissive_strength");
  }
  if (spec.transmission > 0.0) {
    material["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", spec.transmission}};
    document_->use("KHR_materials_transmission");
  }
  if (spec.doubleSided) material["doubleSided"] = true;
  document_->json["materials"].push_back(material);
  return static_cast<MaterialId>(document_->json["materials"].size() - 1);
}

int GltfWriter::addAccessor(const void* data, std::size_t count, std::size_t elementBytes, int componentType,
                            const char* type, std::optional<int> target) {
  binary_.resize((binary_.size() + 3) / 4 *
                 4);  // every accessor begins at a multiple of its component's size
  const std::size_t offset = binary_.size();
  binary_.resize(offset + count * elementBytes);
  std::memcpy(binary_.data() + offset, data, count * elementBytes);
  Json& json = document_->json;
  Json view = {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", count * elementBytes}};
  if (target) view["target"] = *target;
  json["accessors"].push_back({{"bufferView", json["bufferViews"].size()},
                               {"componentType", componentType},
                               {"count", count},
                               {"type", type}});
  json["bufferViews"].push_back(view);
  return static_cast<int>(json["accessors"].size()) - 1;
}

MeshId GltfWriter::addMesh(const std::string& name, const Surface& whole, MaterialId material,
                           glm::dvec2 textureScale) {
  Surface surface = whole;
  surface.indices = withoutDegenerates(whole);
  const std::size_t vertices = surface.positions.size();
  const std::vector<float> positions = flattened(surface.positions), normals = flattened(surface.normals);
  const int position = addAccessor(positions.data(), vertices, 12, kFloat, "VEC3", kArrayBuffer);
  std::tie(document_->json["accessors"].back()["min"], document_->json["accessors"].back()["max"]) =
      bounds(positions, 3);
  Json attributes = {{"POSITION", position},
                     {"NORMAL", addAccessor(normals.data(), vertices, 12, kFloat, "VEC3", kArrayBuffer)}};
  if (document_->json["materials"][static_cast<std::size_t>(material)].dump().find("\"index\"") !=
      std::string::npos) {
    const std::vector<float> texCoords = flattened(surface.scaleTexture(textureScale).texCoords);
    attributes["TEXCOORD_0"] = addAccessor(texCoords.data(), vertices, 8, kFloat, "VEC2", kArrayBuffer);
  }
  int indices = 0;
  if (vertices < 65535) {
    const std::vector<std::uint16_t> small(surface.indices.begin(), surface.indices.end());
    indices = addAccessor(small.data(), small.size(), 2, kUnsignedShort, "SCALAR", kElementArrayBuffer);
  } else {
    indices = addAccessor(surface.indices.data(), surface.indices.size(), 4, kUnsignedInt, "SCALAR",
                          kElementArrayBuffer);
  }
  document_->json["meshes"].push_back(
      {{"name", name},
       {"primitives",
        {{{"attributes", attributes}, {"indices", indices}, {"material", static_cast<int>(material)}}}}});
  meshTriangles_.push_back(surface.triangleCount());
  return static_cast<MeshId>(meshTriangles_.size() - 1);
}

void GltfWriter::addNode(const std::string& name, MeshId mesh, const Placement& placement) {
  Json node = {{"name", name}, {"mesh", static_cast<int>(mesh)}};
  if (placement.translation != glm::dvec3(0.0)) node["translation"] = jsonOf(placement.translation);
  if (placement.yawDegrees != 0.0 || placement.rollDegrees != 0.0) {
    const glm::dquat q = glm::angleAxis(glm::radians(placement.yawDegrees), glm::dvec3(0, 1, 0)) *
                         glm::angleAxis(glm::radians(placement.rollDegrees), glm::dvec3(0, 0, 1));
    node["rotation"] = {q.x, q.y, q.z, q.w};
  }
  if (placement.scale != 1.0) node["scale"] = {placement.scale, placement.scale, placement.scale};
  document_->addRoot(node);
  triangles_ += meshTriangles_[static_cast<std::size_t>(mesh)];
}

void GltfWriter::addWalk(const std::string& name, double verticalFieldOfView,
                         const std::vector<CameraKey>& keys) {
  Json& json = document_->json;
  std::vector<float> times;
  std::vector<glm::dvec3> eyes;
  std::vector<glm::dvec4> rotations;
  for (const CameraKey& key : keys) {
    times.push_back(static_cast<float>(key.seconds));
    eyes.push_back(key.eye);
    rotations.emplace_back(key.rotation.x, key.rotation.y, key.rotation.z, key.rotation.w);
  }
  const std::vector<float> eyeFloats = flattened(eyes), rotationFloats = flattened(rotations);
  const int time = addAccessor(times.data(), times.size(), 4, kFloat, "SCALAR", std::nullopt);
  std::tie(json["accessors"].back()["min"], json["accessors"].back()["max"]) = bounds(times, 1);
  const int eye = addAccessor(eyeFloats.data(), keys.size(), 12, kFloat, "VEC3", std::nullopt);
  const int rotation = addAccessor(rotationFloats.data(), keys.size(), 16, kFloat, "VEC4", std::nullopt);

  const std::size_t camera = json.contains("cameras") ? json["cameras"].size() : 0;
  json["cameras"].push_back(
      {{"name", name},
       {"type", "perspective"},
       {"perspective", {{"aspectRatio", 16.0 / 9.0}, {"yfov", verticalFieldOfView}, {"znear", 0.05}}}});
  const std::size_t node = json["nodes"].size();
  const glm::dquat& first = keys.front().rotation;
  document_->addRoot({{"name", name},
                      {"camera", camera},
                      {"translation", jsonOf(keys.front().eye)},
                      {"rotation", {first.x, first.y, first.z, first.w}}});
  const auto channel = [node](int sampler, const char* path) {
    return Json{{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}};
  };
  const auto sampler = [time](int output) {
    return Json{{"input", time}, {"interpolation", "LINEAR"}, {"output", output}};
  };
  json["animations"].push_back({{"name", name},
                                {"channels", {channel(0, "translation"), channel(1, "rotation")}},
                                {"samplers", {sampler(eye), sampler(rotation)}}});
}

std::size_t GltfWriter::write(const std::filesystem::path& folder, const std::string& name) const {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw std::runtime_error(folder.string() + ": cannot be made: " + failure.message());
  std::size_t bytes = 0;
  for (const NamedPicture& picture : pictures_) {
    writePng(folder / picture.file, picture.picture);
    bytes += std::filesystem::file_size(folder / picture.file);
  }
  Json json = document_->json;
  json["buffers"] = {{{"uri", name + ".bin"}, {"byteLength", binary_.size()}}};
  if (json["extensionsUsed"].empty()) json.erase("extensionsUsed");
  const std::string text = json.dump(1) + "\n";
  writeBytes(folder / (name + ".bin"), binary_.data(), binary_.size());
  writeBytes(folder / (name + ".gltf"), text.data(), text.size());
  return bytes + binary_.size() + text.size();
}

}  // namespace promenade::hall
