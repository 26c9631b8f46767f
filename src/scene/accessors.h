#pragma once
// Internal: typed, bounds-checked reading of accessors (glTF 2.0, 3.6), sparse and interleaved ones included.

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <string>
#include <vector>

#include "src/scene/gltf.h"

namespace promenade::scene {

class Accessors {
 public:
  /// Checks every buffer view and accessor of the file: indices, component types, and that each element lies
  /// within its view and each view within its buffer. Throws InputError.
  Accessors(const Gltf& gltf, Budget& budget);

  [[nodiscard]] std::size_t size() const { return gltf_.model.accessors.size(); }
  /// Precondition: the index is good.
  [[nodiscard]] std::size_t count(int accessor) const {
    return gltf_.model.accessors[static_cast<std::size_t>(accessor)].count;
  }

  /// Elements as floats, integers normalised where the accessor says so. `place` names the property that
  /// refers to it. Throws InputError: no such accessor, not of the expected shape.
  [[nodiscard]] std::vector<float> readScalars(int accessor, const std::string& place) const;
  [[nodiscard]] std::vector<glm::vec2> readVec2(int accessor, const std::string& place) const;
  [[nodiscard]] std::vector<glm::vec3> readVec3(int accessor, const std::string& place) const;
  [[nodiscard]] std::vector<glm::vec4> readVec4(int accessor, const std::string& place) const;
  /// Float matrices, as inverse bind matrices are.
  [[nodiscard]] std::vector<glm::mat4> readMat4(int accessor, const std::string& place) const;
  /// VEC4, or VEC3 with w = 1 (colours).
  [[nodiscard]] std::vector<glm::vec4> readColors(int accessor, const std::string& place) const;
  /// Unsigned integer scalars.
  [[nodiscard]] std::vector<std::uint32_t> readIndices(int accessor, const std::string& place) const;

  /// The bytes of a buffer view. Throws InputError if there is no such view.
  [[nodiscard]] std::span<const std::uint8_t> view(int bufferView, const std::string& place) const;

 private:
  template <class Vector>
  [[nodiscard]] std::vector<Vector> readVectors(int accessor, int type, const std::string& place) const;
  template <class Component, class Convert>
  void decode(const tinygltf::Accessor& accessor, std::size_t components, const std::string& place,
              std::vector<Component>& result, Convert convert) const;
  const tinygltf::Accessor& get(int accessor, const std::string& place) const;

  const Gltf& gltf_;
  Budget& budget_;
};

}  // namespace promenade::scene
