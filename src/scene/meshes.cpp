#include "src/scene/meshes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>

#include "src/scene/geometry.h"

namespace promenade::scene {
namespace {

constexpr float kLargestCoordinate = 1e15f;

template <class Vector>
bool isFinite(const Vector& vector) {
  for (int i = 0; i < Vector::length(); ++i) {
    if (!std::isfinite(vector[i])) {
      return false;
    }
  }
  return true;
}

std::optional<Topology> topologyOf(const Gltf& gltf, int mode, const std::string& place) {
  switch (mode) {
    case TINYGLTF_MODE_TRIANGLES:
      return Topology::kTriangles;
    case TINYGLTF_MODE_TRIANGLE_STRIP:
      return Topology::kTriangleStrip;
    case TINYGLTF_MODE_TRIANGLE_FAN:
      return Topology::kTriangleFan;
    case TINYGLTF_MODE_POINTS:
    case TINYGLTF_MODE_LINE:
    case TINYGLTF_MODE_LINE_LOOP:
    case TINYGLTF_MODE_LINE_STRIP:
      return std::nullopt;
    default:
      gltf.fail(place, "found " + std::to_string(mode) + ", which is no primitive mode of glTF");
  }
}

/// One primitive on its way to a Mesh.
class PrimitiveReader {
 public:
  PrimitiveReader(const Gltf& gltf, const Accessors& accessors, const tinygltf::Primitive& primitive,
                  std::string place, Budget& budget, Warnings& warnings)
      : gltf_(gltf),
        accessors_(accessors),
        primitive_(primitive),
        place_(std::move(place)),
        budget_(budget),
        warnings_(warnings) {}

  /// Nothing if there are no triangles in it.
  [[nodiscard]] std::optional<Mesh> read(const std::vector<Material>& materials,
                                         const std::vector<double>& weights) {
    const std::optional<Topology> topology = topologyOf(gltf_, primitive_.mode, place_ + ".mode");
    if (!topology) {
      warnings_.add("points and lines are not shown (first: " + place_ + ")");
      return std::nullopt;
    }
    if (attribute("POSITION") < 0) {
      warnings_.add(place_ + ": has no POSITION and is left out");
      return std::nullopt;
    }
    readMaterial(materials);
    readPositions();
    readTriangles(*topology);
    if (mesh_.triangles.empty()) {
      warnings_.add(place_ + ": has no triangles and is left out");
      return std::nullopt;
    }
    readColorsAndTexCoords();
    readFrames();
    morph(weights);
    finishFrames(materials[static_cast<std::size_t>(mesh_.material)]);
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] int attribute(const std::string& name) const {
    const auto found = primitive_.attributes.find(name);
    return found == primitive_.attributes.end() ? -1 : found->second;
  }
  [[nodiscard]] std::string placeOf(const std::string& name) const { return place_ + ".attributes." + name; }

  void checkCount(std::size_t count, const std::string& place) const {
    if (count != mesh_.positions.size()) {
      gltf_.fail(place, "expected " + std::to_string(mesh_.positions.size()) +
                            " elements like POSITION, found " + std::to_string(count));
    }
  }

  void readMaterial(const std::vector<Material>& materials) {
    mesh_.material = static_cast<int>(materials.size()) - 1;
    if (primitive_.material >= 0) {
      gltf_.checkIndex(primitive_.material, materials.size() - 1, place_ + ".material", "material");
      mesh_.material = primitive_.material;
    }
  }

  void readPositions() {
    mesh_.positions = accessors_.readVec3(attribute("POSITION"), placeOf("POSITION"));
    checkPositions();
  }

  void checkPositions() const {
    for (const glm::vec3& position : mesh_.positions) {
      for (int i = 0; i < 3; ++i) {
        if (!(std::abs(position[i]) <= kLargestCoordinate)) {  // also false for NaN
          gltf_.fail(placeOf("POSITION"), "found a coordinate that is not finite or beyond 1e15");
        }
      }
    }
  }

  void readTriangles(Topology topology) {
    std::vector<std::uint32_t> indices;
    if (primitive_.indices >= 0) {
      indices = accessors_.readIndices(primitive_.indices, place_ + ".indices");
      const std::uint32_t largest = *std::max_element(indices.begin(), indices.end());
      if (largest >= mesh_.positions.size()) {
        gltf_.fail(place_ + ".indices", "there is no vertex " + std::to_string(largest) + ", POSITION has " +
                                            std::to_string(mesh_.positions.size()));
      }
    } else {
      if (mesh_.positions.size() > UINT32_MAX) {
        gltf_.fail(place_, "has more than 2^32 vertices");
      }
      budget_.chargeGeometry(mesh_.positions.size(), sizeof(std::uint32_t));
      indices.resize(mesh_.positions.size());
      std::iota(indices.begin(), indices.end(), 0u);
    }
    if (topology == Topology::kTriangles && indices.size() % 3 != 0) {
      warnings_.add(place_ + ": its last triangle is not complete");
    }
    const std::size_t most = topology == Topology::kTriangles ? indices.size() / 3 : indices.size();
    budget_.chargeTriangles(most);
    budget_.chargeGeometry(most, sizeof(glm::uvec3));
    mesh_.triangles = triangulate(indices, topology);
  }

  void readColorsAndTexCoords() {
    for (std::size_t set = 0; set < mesh_.texCoords.size(); ++set) {
      const std::string name = "TEXCOORD_" + std::to_string(set);
      if (attribute(name) < 0) {
        continue;
      }
      mesh_.texCoords[set] = accessors_.readVec2(attribute(name), placeOf(name));
      checkCount(mesh_.texCoords[set].size(), placeOf(name));
      for (glm::vec2& texCoord : mesh_.texCoords[set]) {
        if (!isFinite(texCoord)) {
          warnings_.add(placeOf(name) + ": found coordinates that are not finite; 0 is taken");
          texCoord = glm::vec2(0.0f);
        }
      }
    }
    if (attribute("COLOR_0") >= 0) {
      mesh_.colors = accessors_.readColors(attribute("COLOR_0"), placeOf("COLOR_0"));
      checkCount(mesh_.colors.size(), placeOf("COLOR_0"));
      for (glm::vec4& color : mesh_.colors) {
        if (!isFinite(color) || color != glm::clamp(color, 0.0f, 1.0f)) {
          warnings_.add(placeOf("COLOR_0") + ": found colours outside 0 to 1; they are limited");
          color = isFinite(color) ? glm::clamp(color, 0.0f, 1.0f) : glm::vec4(1.0f);
        }
      }
    }
  }

  void readFrames() {
    if (attribute("NORMAL") >= 0) {
      mesh_.normals = accessors_.readVec3(attribute("NORMAL"), placeOf("NORMAL"));
      checkCount(mesh_.normals.size(), placeOf("NORMAL"));
    }
    // Without normals, tangents are to be ignored (glTF 2.0, 3.7.2.1).
    if (!mesh_.normals.empty() && attribute("TANGENT") >= 0) {
      mesh_.tangents = accessors_.readVec4(attribute("TANGENT"), placeOf("TANGENT"));
      checkCount(mesh_.tangents.size(), placeOf("TANGENT"));
    }
  }

  /// Adds weight * displacement to `values` (glTF 2.0, 3.7.2.2).
  template <class Vector>
  void displace(std::vector<Vector>& values, const std::map<std::string, int>& target,
                const std::string& name, double weight, const std::string& place) const {
    const auto found = target.find(name);
    if (found == target.end() || values.empty()) {
      return;
    }
    const std::vector<glm::vec3> displacements = accessors_.readVec3(found->second, place + '.' + name);
    checkCount(displacements.size(), place + '.' + name);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Vector old = values[i];
      for (int c = 0; c < 3; ++c) {
        values[i][c] = old[c] + static_cast<float>(weight) * displacements[i][c];
      }
    }
  }

  void morph(const std::vector<double>& weights) {
    for (std::size_t i = 0; i < std::min(weights.size(), primitive_.targets.size()); ++i) {
      if (weights[i] == 0.0) {
        continue;
      }
      const std::string place = place_ + ".targets[" + std::to_string(i) + "]";
      displace(mesh_.positions, primitive_.targets[i], "POSITION", weights[i], place);
      displace(mesh_.normals, primitive_.targets[i], "NORMAL", weights[i], place);
      displace(mesh_.tangents, primitive_.targets[i], "TANGENT", weights[i], place);
    }
    if (!weights.empty()) {
      checkPositions();
    }
  }

  /// Unit normals and tangents, made where they are missing.
  void finishFrames(const Material& material) {
    if (mesh_.normals.empty()) {
      unshareVertices();
    } else {
      repairNormals();
    }
    repairTangents();
    const std::optional<Texture>& map =
        material.normalTexture ? material.normalTexture : material.clearcoatNormalTexture;
    if (!map || !mesh_.tangents.empty()) {
      return;
    }
    const auto& texCoords = mesh_.texCoords[static_cast<std::size_t>(map->texCoord)];
    if (texCoords.empty()) {
      return;
    }
    budget_.chargeGeometry(mesh_.positions.size(), sizeof(glm::vec4) + 2 * sizeof(glm::dvec3));
    mesh_.tangents =
        generateTangents(mesh_.positions, mesh_.normals, texCoords, mesh_.triangles, map->transform);
  }

  template <class Vector>
  [[nodiscard]] std::vector<Vector> perCorner(const std::vector<Vector>& values) const {
    std::vector<Vector> result;
    if (values.empty()) {
      return result;
    }
    budget_.chargeGeometry(mesh_.triangles.size(), 3 * sizeof(Vector));
    result.reserve(mesh_.triangles.size() * 3);
    for (const glm::uvec3& triangle : mesh_.triangles) {
      for (int corner = 0; corner < 3; ++corner) {
        result.push_back(values[triangle[corner]]);
      }
    }
    return result;
  }

  /// Flat normals (glTF 2.0, 3.7.2.1): every triangle gets vertices of its own.
  void unshareVertices() {
    if (mesh_.triangles.size() > UINT32_MAX / 3) {
      gltf_.fail(place_, "has too many triangles to give them flat normals");
    }
    mesh_.positions = perCorner(mesh_.positions);
    for (auto& texCoords : mesh_.texCoords) {
      texCoords = perCorner(texCoords);
    }
    mesh_.colors = perCorner(mesh_.colors);
    budget_.chargeGeometry(mesh_.positions.size(), sizeof(glm::vec3));
    mesh_.normals.reserve(mesh_.positions.size());
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      const auto first = static_cast<std::uint32_t>(3 * i);
      mesh_.triangles[i] = {first, first + 1, first + 2};
      const glm::vec3 normal =
          faceNormal(mesh_.positions[first], mesh_.positions[first + 1], mesh_.positions[first + 2]);
      mesh_.normals.insert(mesh_.normals.end(), 3, normal);
    }
  }

  void repairNormals() {
    std::vector<glm::vec3> replacements;
    for (std::size_t i = 0; i < mesh_.normals.size(); ++i) {
      const double length = glm::length(glm::dvec3(mesh_.normals[i]));
      if (length > 0.0 && std::isfinite(length)) {
        mesh_.normals[i] = glm::vec3(glm::dvec3(mesh_.normals[i]) / length);
        continue;
      }
      if (replacements.empty()) {
        warnings_.add(placeOf("NORMAL") +
                      ": found normals without a direction; they are made from the triangles");
        replacements = smoothNormals(mesh_.positions, mesh_.triangles);
      }
      mesh_.normals[i] = replacements[i];
    }
  }

  void repairTangents() {
    for (std::size_t i = 0; i < mesh_.tangents.size(); ++i) {
      const glm::dvec3 tangent(mesh_.tangents[i]);
      const double length = glm::length(tangent);
      const bool good = length > 0.0 && std::isfinite(length);
      mesh_.tangents[i] = glm::vec4(good ? glm::vec3(tangent / length) : anyOrthogonal(mesh_.normals[i]),
                                    mesh_.tangents[i].w < 0.0f ? -1.0f : 1.0f);
    }
  }

  const Gltf& gltf_;
  const Accessors& accessors_;
  const tinygltf::Primitive& primitive_;
  std::string place_;
  Budget& budget_;
  Warnings& warnings_;
  Mesh mesh_;
};

}  // namespace

std::vector<int> MeshStore::meshesOf(const tinygltf::Node& node) {
  const auto meshIndex = static_cast<std::size_t>(node.mesh);
  const tinygltf::Mesh& source = gltf_.model.meshes[meshIndex];
  std::vector<double> weights = node.weights.empty() ? source.weights : node.weights;
  if (std::all_of(weights.begin(), weights.end(), [](double weight) { return weight == 0.0; })) {
    weights.clear();
  }
  std::vector<int> result;
  for (std::size_t i = 0; i < source.primitives.size(); ++i) {
    const auto [found, isNew] = built_.try_emplace(Key(node.mesh, i, weights), -1);
    if (isNew) {
      const std::string place = at("meshes", meshIndex) + ".primitives[" + std::to_string(i) + "]";
      if (!source.primitives[i].targets.empty()) {
        warnings_.add("morph targets are shown at rest");
      }
      PrimitiveReader reader(gltf_, accessors_, source.primitives[i], place, budget_, warnings_);
      if (std::optional<Mesh> mesh = reader.read(materials_, weights)) {
        mesh->name = printable(source.name);
        found->second = static_cast<int>(meshes_.size());
        meshes_.push_back(std::move(*mesh));
      }
    }
    if (found->second >= 0) {
      result.push_back(found->second);
    }
  }
  return result;
}

}  // namespace promenade::scene
