#pragma once
// Collects a scene and writes it as glTF 2.0: one .gltf, one .bin, one .png an image. The same calls in the
// same order give the same bytes.

#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "examples/hall/picture.h"
#include "examples/hall/surface.h"

namespace promenade::hall {

enum class ImageId : int {};
enum class MaterialId : int {};
enum class MeshId : int {};

/// Metallic-roughness; what is not given is left out of the file.
struct MaterialSpec {
  std::string name;
  Color baseColor{1.0};  ///< linear
  std::optional<ImageId> baseColorImage{};
  double metallic = 0.0;
  double roughness = 1.0;
  std::optional<ImageId> normalImage{};
  Color emission{0.0};        ///< linear radiance; above 1 through KHR_materials_emissive_strength
  double transmission = 0.0;  ///< thin-walled (KHR_materials_transmission)
  bool doubleSided = false;
};

struct Placement {
  glm::dvec3 translation{0.0};
  double yawDegrees = 0.0;   ///< about +Y, applied after `rollDegrees`
  double rollDegrees = 0.0;  ///< about +Z
  double scale = 1.0;
};

struct CameraKey {
  double seconds;
  glm::dvec3 eye;
  glm::dquat rotation;  ///< worldFromCamera; the camera looks along -Z
};

class GltfWriter {
 public:
  GltfWriter();
  GltfWriter(const GltfWriter&) = delete;
  GltfWriter& operator=(const GltfWriter&) = delete;
  ~GltfWriter();

  ImageId addImage(const std::string& name, Picture picture);
  MaterialId addMaterial(const MaterialSpec& spec);
  /// Texture coordinates are multiplied by `textureScale` (periods a metre).
  MeshId addMesh(const std::string& name, const Surface& surface, MaterialId material,
                 glm::dvec2 textureScale = {1.0, 1.0});
  void addNode(const std::string& name, MeshId mesh, const Placement& placement = {});
  /// A perspective camera, 16:9, moved by linear interpolation between the keys.
  void addWalk(const std::string& name, double verticalFieldOfView, const std::vector<CameraKey>& keys);

  /// Writes `folder`/`name`.gltf, `folder`/`name`.bin and the images. Creates the folder; overwrites.
  /// Returns the bytes written. Throws std::runtime_error naming the file that cannot be written.
  std::size_t write(const std::filesystem::path& folder, const std::string& name) const;
  /// Triangles of all nodes, shared meshes counted once a node.
  [[nodiscard]] std::size_t triangleCount() const { return triangles_; }

 private:
  struct Document;  // keeps JSON out of this header
  struct NamedPicture {
    std::string file;
    Picture picture;
  };
  int addAccessor(const void* data, std::size_t count, std::size_t elementBytes, int componentType,
                  const char* type, std::optional<int> target);

  std::unique_ptr<Document> document_;
  std::vector<NamedPicture> pictures_;
  std::vector<std::size_t> meshTriangles_;
  std::vector<char> binary_;
  std::size_t triangles_ = 0;
};

}  // namespace promenade::hall
