#include "src/scene/accessors.h"

#include <algorithm>
#include <cstring>

namespace promenade::scene {
namespace {

/// 0 for a component type that glTF does not have.
std::size_t componentSize(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

/// Bytes of one element, with the padding of matrix columns to 4 bytes (glTF 2.0, 3.6.2.4).
std::size_t elementSize(const tinygltf::Accessor& accessor) {
  const std::size_t component = componentSize(accessor.componentType);
  const auto columns = [component](std::size_t n) { return n * ((n * component + 3) / 4 * 4); };
  switch (accessor.type) {
    case TINYGLTF_TYPE_MAT2:
      return columns(2);
    case TINYGLTF_TYPE_MAT3:
      return columns(3);
    case TINYGLTF_TYPE_MAT4:
      return columns(4);
    default:
      return component *
             static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type)));
  }
}

/// Whether `count` elements of `size` bytes, `stride` apart from `offset` on, end within `length`. No product
/// overflows: count and stride are below 2^53 and 2^8.
bool fits(std::uint64_t offset, std::uint64_t count, std::uint64_t stride, std::uint64_t size,
          std::uint64_t length) {
  if (count == 0) {
    return offset <= length;
  }
  return offset <= length && size <= length - offset && (count - 1) <= (length - offset - size) / stride;
}

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

bool isIndexType(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

void checkViews(const Gltf& gltf) {
  const auto& views = gltf.model.bufferViews;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const tinygltf::BufferView& view = views[i];
    gltf.checkIndex(view.buffer, gltf.bufferSources.size(), at("bufferViews", i) + ".buffer", "buffer");
    const std::uint64_t length = gltf.bufferSources[static_cast<std::size_t>(view.buffer)].byteLength;
    if (!fits(view.byteOffset, 1, 1, view.byteLength, length)) {
      gltf.fail(at("bufferViews", i), "bytes " + std::to_string(view.byteOffset) + " + " +
                                          std::to_string(view.byteLength) + " are more than the " +
                                          std::to_string(length) + " bytes of its buffer");
    }
    if (view.byteStride != 0 && (view.byteStride < 4 || view.byteStride > 252 || view.byteStride % 4 != 0)) {
      gltf.fail(at("bufferViews", i) + ".byteStride",
                "expected a multiple of 4 from 4 to 252, found " + std::to_string(view.byteStride));
    }
  }
}

void checkSparse(const Gltf& gltf, const tinygltf::Accessor& accessor, const std::string& place) {
  const auto& sparse = accessor.sparse;
  const auto& views = gltf.model.bufferViews;
  if (sparse.count < 1 || static_cast<std::uint64_t>(sparse.count) > accessor.count) {
    gltf.fail(place + ".count",
              "expected 1 to " + std::to_string(accessor.count) + ", found " + std::to_string(sparse.count));
  }
  if (!isIndexType(sparse.indices.componentType)) {
    gltf.fail(place + ".indices.componentType", "expected an unsigned integer type");
  }
  gltf.checkIndex(sparse.indices.bufferView, views.size(), place + ".indices.bufferView", "buffer view");
  gltf.checkIndex(sparse.values.bufferView, views.size(), place + ".values.bufferView", "buffer view");
  const auto inside = [&](int view, int offset, std::size_t size) {
    return offset >= 0 && fits(static_cast<std::uint64_t>(offset), static_cast<std::uint64_t>(sparse.count),
                               size, size, views[static_cast<std::size_t>(view)].byteLength);
  };
  if (!inside(sparse.indices.bufferView, sparse.indices.byteOffset,
              componentSize(sparse.indices.componentType)) ||
      !inside(sparse.values.bufferView, sparse.values.byteOffset, elementSize(accessor))) {
    gltf.fail(place, "its " + std::to_string(sparse.count) + " elements do not fit their buffer views");
  }
}

void checkAccessors(const Gltf& gltf) {
  const auto& accessors = gltf.model.accessors;
  for (std::size_t i = 0; i < accessors.size(); ++i) {
    const tinygltf::Accessor& accessor = accessors[i];
    const std::string place = at("accessors", i);
    if (componentSize(accessor.componentType) == 0) {
      gltf.fail(place + ".componentType",
                "found " + std::to_string(accessor.componentType) + ", which glTF does not have");
    }
    if (accessor.count < 1) {
      gltf.fail(place + ".count", "expected at least 1, found 0");
    }
    if (accessor.sparse.isSparse) {
      checkSparse(gltf, accessor, place + ".sparse");
    }
    if (accessor.bufferView < 0) {
      continue;  // all zero, or sparse
    }
    gltf.checkIndex(accessor.bufferView, gltf.model.bufferViews.size(), place + ".bufferView", "buffer view");
    const tinygltf::BufferView& view = gltf.model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
    const std::size_t size = elementSize(accessor);
    if (view.byteStride != 0 && view.byteStride < size) {
      gltf.fail(place, "its elements of " + std::to_string(size) + " bytes overlap in a byteStride of " +
                           std::to_string(view.byteStride));
    }
    const std::size_t stride = view.byteStride != 0 ? view.byteStride : size;
    if (!fits(accessor.byteOffset, accessor.count, stride, size, view.byteLength)) {
      gltf.fail(place, std::to_string(accessor.count) + " elements of " + std::to_string(size) +
                           " bytes from byte " + std::to_string(accessor.byteOffset) + " on do not fit the " +
                           std::to_string(view.byteLength) + " bytes of their buffer view");
    }
  }
}

}  // namespace

Accessors::Accessors(const Gltf& gltf, Budget& budget) : gltf_(gltf), budget_(budget) {
  checkViews(gltf);
  checkAccessors(gltf);
}

const tinygltf::Accessor& Accessors::get(int accessor, const std::string& place) const {
  gltf_.checkIndex(accessor, size(), place, "accessor");
  return gltf_.model.accessors[static_cast<std::size_t>(accessor)];
}

std::span<const std::uint8_t> Accessors::view(int bufferView, const std::string& place) const {
  gltf_.checkIndex(bufferView, gltf_.model.bufferViews.size(), place, "buffer view");
  const tinygltf::BufferView& found = gltf_.model.bufferViews[static_cast<std::size_t>(bufferView)];
  const Bytes& bytes = *gltf_.buffers[static_cast<std::size_t>(found.buffer)];
  return std::span<const std::uint8_t>(bytes).subspan(found.byteOffset, found.byteLength);
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
