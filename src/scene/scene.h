#pragma once
// A static scene, ready to be traced: everything validated, every index in range, world units in metres.

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/mat4x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "src/core/animation.h"
#include "src/core/image.h"
#include "src/scene/texture_image.h"

namespace promenade {

enum class Wrap { kRepeat, kMirroredRepeat, kClampToEdge };
enum class Filter { kNearest, kLinear };
/// How texels are to be read: sRGB-encoded colour, plain numbers, or unit vectors n as (n + 1) / 2.
enum class TexelEncoding { kSrgb, kLinear, kNormal };

/// A use of an image by a material.
struct Texture {
  int image = -1;
  Wrap wrapU = Wrap::kRepeat;
  Wrap wrapV = Wrap::kRepeat;
  Filter magnification = Filter::kLinear;
  bool mipmapped = true;  ///< false: the sampler's minification filter is NEAREST or LINEAR
  TexelEncoding encoding = TexelEncoding::kLinear;
  int texCoord = 0;  ///< 0 or 1
  /// KHR_texture_transform, applied to homogeneous (u, v, 1).
  glm::mat3 transform{1.0f};
};

enum class AlphaMode { kOpaque, kMask, kBlend };

/// glTF 2.0 metallic-roughness with the extensions of the loader; factors and textures multiply.
struct Material {
  std::string name;
  glm::vec4 baseColor{1.0f};
  std::optional<Texture> baseColorTexture;  // sRGB, A = alpha
  float metallic = 1.0f;
  float roughness = 1.0f;                           ///< perceptual; alpha of the microfacets is its square
  std::optional<Texture> metallicRoughnessTexture;  // G roughness, B metallic
  std::optional<Texture> normalTexture;             // TexelEncoding::kNormal
  float normalScale = 1.0f;
  Rgb emission{0.0f};                      ///< emissiveFactor * KHR_materials_emissive_strength
  std::optional<Texture> emissionTexture;  // sRGB
  AlphaMode alphaMode = AlphaMode::kOpaque;
  float alphaCutoff = 0.5f;
  bool doubleSided = false;
  bool unlit = false;                          // KHR_materials_unlit: emits its base colour, reflects nothing
  float ior = 1.5f;                            // KHR_materials_ior
  float transmission = 0.0f;                   // KHR_materials_transmission
  std::optional<Texture> transmissionTexture;  // R
  float thickness = 0.0f;  // KHR_materials_volume; 0: thin-walled (light goes straight through)
  float attenuationDistanceMetres = std::numeric_limits<float>::infinity();
  Rgb attenuationColor{1.0f};
  float specular = 1.0f;                   // KHR_materials_specular
  std::optional<Texture> specularTexture;  // A
  Rgb specularColor{1.0f};
  std::optional<Texture> specularColorTexture;  // sRGB
  float clearcoat = 0.0f;                       // KHR_materials_clearcoat
  std::optional<Texture> clearcoatTexture;      // R
  float clearcoatRoughness = 0.0f;
  std::optional<Texture> clearcoatRoughnessTexture;  // G
  std::optional<Texture> clearcoatNormalTexture;     ///< without it the coat is as smooth as the mesh
  float clearcoatNormalScale = 1.0f;
};

/// Triangles with one material, in object space. Attribute arrays are empty or as long as `positions`.
struct Mesh {
  std::string name;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  ///< unit; never empty (flat normals are generated where the file has none)
  std::vector<glm::vec4> tangents;  ///< xyz unit, w = handedness; generated where a normal map needs them
  std::array<std::vector<glm::vec2>, 2> texCoords;
  std::vector<glm::vec4> colors;  ///< linear, multiply the base colour
  std::vector<glm::uvec3> triangles;
  int material = 0;
};

/// A placed mesh. Its ItemId is its index in Scene::instances plus one.
struct Instance {
  std::string name;
  int mesh = 0;
  glm::mat4x3 worldFromObject{1.0f};
};

/// KHR_lights_punctual. Intensity: candela (point, spot: W/sr in scene units), lux (directional).
struct PunctualLight {
  enum class Type { kPoint, kSpot, kDirectional };
  std::string name;
  Type type = Type::kPoint;
  Rgb intensity{1.0f};  ///< color * intensity
  glm::vec3 position{0.0f};
  glm::vec3 direction{0.0f, 0.0f, -1.0f};  ///< unit, the way the light travels along its axis
  float rangeMetres = std::numeric_limits<float>::infinity();
  float innerConeRadians = 0.0f;
  float outerConeRadians = 0.7853982f;
};

/// Light from infinity: latitude-longitude radiance. World direction d is read at u = 0.5 + atan2(d.x, -d.z)
/// / (2 pi), v = acos(d.y) / pi (the centre of the image looks toward -Z, its top toward +Y).
struct Environment {
  RadianceMap radiance;          ///< 1x1 for a uniform sky
  double rotationRadians = 0.0;  ///< about +Y
};

struct Scene {
  std::string source;  ///< the file it came from, for messages
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<Material> materials;  ///< never empty: the default material is there when the file has none
  std::vector<TextureImage> images;
  int textureMegabytes = 1024;  ///< for decoded texels, with their mip levels
  std::vector<PunctualLight> lights;
  std::optional<Environment> environment;
  std::vector<CameraAnimation>
      cameras;  ///< each camera at rest, then each camera under each animation that moves it
  std::vector<std::string> warnings;  ///< one line each, said once
};

}  // namespace promenade
