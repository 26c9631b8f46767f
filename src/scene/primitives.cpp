#include "src/scene/primitives.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>

#include "src/scene/frames.h"
#include "src/scene/geometry.h"
#include "src/scene/skins.h"
#include "src/scene/values.h"

namespace promenade::scene {
namespace {

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
                                         const std::vector<double>& weights, const Joints* joints) {
    const std::optional<Topology> topology = topologyOf(gltf_, primitive_.mode, place_ + ".mode");
    assert(topology && attribute("POSITION") >= 0);
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
    if (joints != nullptr && !pose(*joints)) {
      return std::nullopt;
    }
    return finishFrames(std::move(mesh_), materials[static_cast<std::size_t>(mesh_.material)], gltf_, place_,
                        budget_, warnings_);
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
      bool bad = false;
      for (glm::vec2& texCoord : mesh_.texCoords[set]) {
        if (!isFinite(texCoord)) {
          bad = true;
          texCoord = glm::vec2(0.0f);
        }
      }
      if (bad) {
        warnings_.add(placeOf(name) + ": found coordinates that are not finite; 0 is taken");
      }
    }
    if (attribute("COLOR_0") >= 0) {
      mesh_.colors = accessors_.readColors(attribute("COLOR_0"), placeOf("COLOR_0"));
      checkCount(mesh_.colors.size(), placeOf("COLOR_0"));
      bool bad = false;
      for (glm::vec4& color : mesh_.colors) {
        if (!isFinite(color) || color != glm::clamp(color, 0.0f, 1.0f)) {
          bad = true;
          color = isFinite(color) ? glm::clamp(color, 0.0f, 1.0f) : glm::vec4(1.0f);
        }
      }
      if (bad) {
        warnings_.add(placeOf("COLOR_0") + ": found colours outside 0 to 1; they are limited");
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

  /// False if the primitive has nothing to bind it to joints.
  [[nodiscard]] bool pose(const Joints& joints) {
    Binding binding;
    for (int set = 0; set < 2; ++set) {
      const std::string jointsName = "JOINTS_" + std::to_string(set);
      const std::string weightsName = "WEIGHTS_" + std::to_string(set);
      if (attribute(jointsName) < 0 || attribute(weightsName) < 0) {
        break;
      }
      binding.joints.push_back(accessors_.readVec4(attribute(jointsName), placeOf(jointsName)));
      binding.weights.push_back(accessors_.readVec4(attribute(weightsName), placeOf(weightsName)));
      checkCount(binding.joints.back().size(), placeOf(jointsName));
      checkCount(binding.weights.back().size(), placeOf(weightsName));
    }
    if (binding.joints.empty()) {
      warnings_.add(place_ + ": its node has a skin, but it has no JOINTS_0 and WEIGHTS_0; it is left out");
      return false;
    }
    mesh_ = poseMesh(std::move(mesh_), binding, joints, gltf_, placeOf("JOINTS_0"));
    checkPositions();
    return true;
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

bool hasTriangles(const Gltf& gltf, const tinygltf::Primitive& primitive, const std::string& place,
                  Warnings& warnings) {
  if (!topologyOf(gltf, primitive.mode, place + ".mode")) {
    warnings.add("points and lines are not shown");
    return false;
  }
  if (!primitive.attributes.contains("POSITION")) {
    warnings.add(place + ": has no POSITION and is left out");
    return false;
  }
  return true;
}

std::optional<Mesh> readPrimitive(const Gltf& gltf, const Accessors& accessors,
                                  const tinygltf::Primitive& primitive, const std::string& place,
                                  const std::vector<Material>& materials, const Pose& pose, Budget& budget,
                                  Warnings& warnings) {
  return PrimitiveReader(gltf, accessors, primitive, place, budget, warnings)
      .read(materials, pose.weights, pose.joints);
}

}  // namespace promenade::scene
