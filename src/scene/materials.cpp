#include "src/scene/materials.h"

#include "src/scene/textures.h"
#include "src/scene/values.h"

namespace promenade::scene {
namespace {

class MaterialReader {
 public:
  MaterialReader(const Gltf& gltf, std::size_t index, const TextureReader& textures, Warnings& warnings)
      : gltf_(gltf),
        source_(gltf.model.materials[index]),
        place_(at("materials", index)),
        textures_(textures),
        warnings_(warnings) {}

  [[nodiscard]] Material read() {
    material_.name = printable(source_.name);
    readMetallicRoughness();
    readSurface();
    readEmission();
    readTransmission();
    readSpecular();
    readClearcoat();
    return std::move(material_);
  }

 private:
  [[nodiscard]] float unit(double value, const std::string& place) const {
    return limited(toFloat(gltf_, value, place), 0.0f, 1.0f, place, warnings_);
  }
  [[nodiscard]] float unit(const Fields& fields, const char* key, float fallback) const {
    return limited(fields.number(key, fallback), 0.0f, 1.0f, fields.place(key), warnings_);
  }
  [[nodiscard]] Fields extensionOf(const char* name) const {
    return extension(gltf_, source_.extensions, name, place_);
  }

  void readMetallicRoughness() {
    const tinygltf::PbrMetallicRoughness& pbr = source_.pbrMetallicRoughness;
    const std::string where = place_ + ".pbrMetallicRoughness";
    for (int i = 0; i < 4; ++i) {
      material_.baseColor[i] =
          unit(pbr.baseColorFactor.at(static_cast<std::size_t>(i)), where + ".baseColorFactor");
    }
    material_.baseColorTexture =
        textures_.read(pbr.baseColorTexture, TexelEncoding::kSrgb, where + ".baseColorTexture");
    material_.metallic = unit(pbr.metallicFactor, where + ".metallicFactor");
    material_.roughness = unit(pbr.roughnessFactor, where + ".roughnessFactor");
    material_.metallicRoughnessTexture = textures_.read(pbr.metallicRoughnessTexture, TexelEncoding::kLinear,
                                                        where + ".metallicRoughnessTexture");
  }

  void readSurface() {
    material_.normalTexture =
        textures_.read(source_.normalTexture, TexelEncoding::kNormal, place_ + ".normalTexture");
    material_.normalScale = toFloat(gltf_, source_.normalTexture.scale, place_ + ".normalTexture.scale");
    if (source_.alphaMode == "MASK") {
      material_.alphaMode = AlphaMode::kMask;
    } else if (source_.alphaMode == "BLEND") {
      material_.alphaMode = AlphaMode::kBlend;
    } else if (!source_.alphaMode.empty() && source_.alphaMode != "OPAQUE") {
      gltf_.fail(place_ + ".alphaMode",
                 "expected OPAQUE, MASK or BLEND, found " + inQuotes(source_.alphaMode));
    }
    material_.alphaCutoff = toFloat(gltf_, source_.alphaCutoff, place_ + ".alphaCutoff");
    material_.doubleSided = source_.doubleSided;
    material_.unlit = static_cast<bool>(extensionOf("KHR_materials_unlit"));
  }

  void readEmission() {
    const Fields extra = extensionOf("KHR_materials_emissive_strength");
    const float strength = limited(extra.number("emissiveStrength", 1.0f), 0.0f, 1e9f,
                                   extra.place("emissiveStrength"), warnings_);
    for (int i = 0; i < 3; ++i) {
      const std::string where = place_ + ".emissiveFactor";
      material_.emission[i] =
          strength * limited(toFloat(gltf_, source_.emissiveFactor.at(static_cast<std::size_t>(i)), where),
                             0.0f, 1e9f, where, warnings_);
    }
    material_.emissionTexture =
        textures_.read(source_.emissiveTexture, TexelEncoding::kSrgb, place_ + ".emissiveTexture");
  }

  void readTransmission() {
    const Fields transmission = extensionOf("KHR_materials_transmission");
    material_.transmission = unit(transmission, "transmissionFactor", 0.0f);
    material_.transmissionTexture =
        textures_.read(transmission.object("transmissionTexture"), TexelEncoding::kLinear);
    const Fields volume = extensionOf("KHR_materials_volume");
    material_.thickness = limited(volume.number("thicknessFactor", 0.0f), 0.0f, 1e9f,
                                  volume.place("thicknessFactor"), warnings_);
    const float distance = volume.number("attenuationDistance", material_.attenuationDistanceMetres);
    if (distance > 0.0f) {
      material_.attenuationDistanceMetres = distance;
    } else {
      warnings_.add(volume.place("attenuationDistance") + ": expected more than 0; nothing is absorbed");
    }
    const glm::vec3 color = volume.vector("attenuationColor", glm::vec3(1.0f));
    for (int i = 0; i < 3; ++i) {
      material_.attenuationColor[i] =
          limited(color[i], 0.0f, 1.0f, volume.place("attenuationColor"), warnings_);
    }
    const Fields ior = extensionOf("KHR_materials_ior");
    material_.ior = limited(ior.number("ior", 1.5f), 1.0f, 100.0f, ior.place("ior"), warnings_);
  }

  void readSpecular() {
    const Fields specular = extensionOf("KHR_materials_specular");
    material_.specular = unit(specular, "specularFactor", 1.0f);
    material_.specularTexture = textures_.read(specular.object("specularTexture"), TexelEncoding::kLinear);
    const glm::vec3 color = specular.vector("specularColorFactor", glm::vec3(1.0f));
    for (int i = 0; i < 3; ++i) {
      material_.specularColor[i] =
          limited(color[i], 0.0f, 1e3f, specular.place("specularColorFactor"), warnings_);
    }
    material_.specularColorTexture =
        textures_.read(specular.object("specularColorTexture"), TexelEncoding::kSrgb);
  }

  void readClearcoat() {
    const Fields coat = extensionOf("KHR_materials_clearcoat");
    material_.clearcoat = unit(coat, "clearcoatFactor", 0.0f);
    material_.clearcoatTexture = textures_.read(coat.object("clearcoatTexture"), TexelEncoding::kLinear);
    material_.clearcoatRoughness = unit(coat, "clearcoatRoughnessFactor", 0.0f);
    material_.clearcoatRoughnessTexture =
        textures_.read(coat.object("clearcoatRoughnessTexture"), TexelEncoding::kLinear);
    const Fields normal = coat.object("clearcoatNormalTexture");
    material_.clearcoatNormalTexture = textures_.read(normal, TexelEncoding::kNormal);
    material_.clearcoatNormalScale = normal.number("scale", 1.0f);
  }

  const Gltf& gltf_;
  const tinygltf::Material& source_;
  std::string place_;
  const TextureReader& textures_;
  Warnings& warnings_;
  Material material_;
};

}  // namespace

std::vector<Material> readMaterials(const Gltf& gltf, ImageStore& images, Warnings& warnings) {
  const TextureReader textures(gltf, images, warnings);
  std::vector<Material> materials;
  for (std::size_t i = 0; i < gltf.model.materials.size(); ++i) {
    materials.push_back(MaterialReader(gltf, i, textures, warnings).read());
  }
  materials.emplace_back().name = "default";
  return materials;
}

}  // namespace promenade::scene
