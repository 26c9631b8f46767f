#include "src/scene/accessors.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "src/scene/accessor_layout.h"

namespace promenade::scene {
namespace {

template <class T>
T load(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

/// glTF 2.0, 3.6.2.2: signed values are divided by the largest positive one and clamped to -1.
float toFloat(const std::uint8_t* bytes, int type, bool normalized) {
  const auto divided = [normalized](auto value, float most) {
    return normalized ? std::max(static_cast<float>(value) / most, -1.0f) : static_cast<float>(value);
  };
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return divided(load<std::int8_t>(bytes), 127.0f);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return divided(*bytes, 255.0f);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return divided(load<std::int16_t>(bytes), 32767.0f);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return divided(load<std::uint16_t>(bytes), 65535.0f);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return divided(load<std::uint32_t>(bytes), 4294967295.0f);
    default:
      return load<float>(bytes);
  }
}

std::uint32_t toIndex(const std::uint8_t* bytes, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return *bytes;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(bytes);
    default:
      return load<std::uint32_t>(bytes);
  }
}

}  // namespace

Accessors::Accessors(const Gltf& gltf, Budget& budget) : gltf_(gltf), budget_(budget) {
  checkAccessorLayout(gltf);
}

const tinygltf::Accessor& Accessors::get(int accessor, const std::string& place) const {
  gltf_.checkIndex(accessor, size(), place, "accessor");
  return gltf_.model.accessors[static_cast<std::size_t>(accessor)];
}

std::span<const std::uint8_t> Accessors::view(int bufferView, const std::string& place) const {
  gltf_.checkIndex(bufferView, gltf_.model.bufferViews.size(), place, "buffer view");
  const tinygltf::BufferView& found = gltf_.model.bufferViews[static_cast<std::size_t>(bufferView)];
  const std::shared_ptr<const Bytes>& bytes = gltf_.buffers[static_cast<std::size_t>(found.buffer)];
  if (!bytes) {
    gltf_.fail(at("buffers", static_cast<std::size_t>(found.buffer)),
               "has no uri, and there is no binary chunk for it");
  }
  return std::span<const std::uint8_t>(*bytes).subspan(found.byteOffset, found.byteLength);
}

template <class Component, class Convert>
void Accessors::decode(const tinygltf::Accessor& accessor, std::size_t components, const std::string& place,
                       std::vector<Component>& result, Convert convert) const {
  budget_.chargeGeometry(accessor.count, components * sizeof(Component));
  result.assign(accessor.count * components, Component{});
  const std::size_t step = componentSize(accessor.componentType);
  if (accessor.bufferView >= 0) {
    const std::span<const std::uint8_t> bytes = view(accessor.bufferView, place);
    const std::size_t byteStride =
        gltf_.model.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
    const std::size_t stride = byteStride != 0 ? byteStride : elementSize(accessor);
    for (std::size_t i = 0; i < accessor.count; ++i) {
      const std::uint8_t* element = bytes.data() + accessor.byteOffset + i * stride;
      for (std::size_t c = 0; c < components; ++c) {
        result[i * components + c] = convert(element + c * step, accessor.componentType);
      }
    }
  }
  if (!accessor.sparse.isSparse) {
    return;
  }
  const auto& sparse = accessor.sparse;
  const std::uint8_t* indices = view(sparse.indices.bufferView, place).data() + sparse.indices.byteOffset;
  const std::uint8_t* values = view(sparse.values.bufferView, place).data() + sparse.values.byteOffset;
  const std::size_t indexSize = componentSize(sparse.indices.componentType);
  std::int64_t previous = -1;
  for (std::size_t i = 0; i < static_cast<std::size_t>(sparse.count); ++i) {
    const std::size_t index = toIndex(indices + i * indexSize, sparse.indices.componentType);
    if (index >= accessor.count || static_cast<std::int64_t>(index) <= previous) {
      gltf_.fail(place, "its sparse indices must increase and stay below " + std::to_string(accessor.count) +
                            ", found " + std::to_string(index));
    }
    previous = static_cast<std::int64_t>(index);
    for (std::size_t c = 0; c < components; ++c) {
      result[index * components + c] =
          convert(values + i * elementSize(accessor) + c * step, accessor.componentType);
    }
  }
}

std::vector<float> Accessors::readScalars(int accessor, const std::string& place) const {
  const tinygltf::Accessor& found = get(accessor, place);
  if (found.type != TINYGLTF_TYPE_SCALAR) {
    gltf_.fail(place, "expected an accessor of type SCALAR");
  }
  std::vector<float> result;
  decode(found, 1, place, result,
         [&](const std::uint8_t* bytes, int type) { return toFloat(bytes, type, found.normalized); });
  return result;
}

template <class Vector>
std::vector<Vector> Accessors::readVectors(int accessor, int type, const std::string& place) const {
  const tinygltf::Accessor& found = get(accessor, place);
  if (found.type != type) {
    gltf_.fail(place, "expected an accessor of type VEC" + std::to_string(Vector::length()));
  }
  constexpr auto kLength = static_cast<std::size_t>(Vector::length());
  std::vector<float> components;
  decode(found, kLength, place, components, [&](const std::uint8_t* bytes, int componentType) {
    return toFloat(bytes, componentType, found.normalized);
  });
  std::vector<Vector> result(found.count);
  static_assert(sizeof(Vector) == kLength * sizeof(float));
  std::memcpy(static_cast<void*>(result.data()), components.data(), components.size() * sizeof(float));
  return result;
}

std::vector<glm::vec2> Accessors::readVec2(int accessor, const std::string& place) const {
  return readVectors<glm::vec2>(accessor, TINYGLTF_TYPE_VEC2, place);
}

std::vector<glm::vec3> Accessors::readVec3(int accessor, const std::string& place) const {
  return readVectors<glm::vec3>(accessor, TINYGLTF_TYPE_VEC3, place);
}

std::vector<glm::vec4> Accessors::readVec4(int accessor, const std::string& place) const {
  return readVectors<glm::vec4>(accessor, TINYGLTF_TYPE_VEC4, place);
}

std::vector<glm::mat4> Accessors::readMat4(int accessor, const std::string& place) const {
  const tinygltf::Accessor& found = get(accessor, place);
  if (found.type != TINYGLTF_TYPE_MAT4 || found.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT) {
    gltf_.fail(place, "expected an accessor of MAT4 of floats");
  }
  std::vector<float> components;
  decode(found, 16, place, components,
         [](const std::uint8_t* bytes, int componentType) { return toFloat(bytes, componentType, false); });
  std::vector<glm::mat4> result(found.count);
  std::memcpy(static_cast<void*>(result.data()), components.data(), components.size() * sizeof(float));
  for (float component : components) {
    if (!std::isfinite(component)) {
      gltf_.fail(place, "found a number that is not finite");
    }
  }
  return result;
}

std::vector<glm::vec4> Accessors::readColors(int accessor, const std::string& place) const {
  if (get(accessor, place).type != TINYGLTF_TYPE_VEC3) {
    return readVec4(accessor, place);
  }
  const std::vector<glm::vec3> opaque = readVec3(accessor, place);
  std::vector<glm::vec4> result;
  result.reserve(opaque.size());
  for (const glm::vec3& color : opaque) {
    result.emplace_back(color, 1.0f);
  }
  return result;
}

std::vector<std::uint32_t> Accessors::readIndices(int accessor, const std::string& place) const {
  const tinygltf::Accessor& found = get(accessor, place);
  if (found.type != TINYGLTF_TYPE_SCALAR || !isIndexType(found.componentType) || found.normalized) {
    gltf_.fail(place, "expected an accessor of unsigned integer SCALARs");
  }
  std::vector<std::uint32_t> result;
  decode(found, 1, place, result, toIndex);
  return result;
}

}  // namespace promenade::scene
