#include "src/scene/accessor_layout.h"

namespace promenade::scene {

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

bool isIndexType(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

namespace {

/// The last column needs no padding after it.
std::size_t lastElementSize(const tinygltf::Accessor& accessor) {
  const std::size_t component = componentSize(accessor.componentType);
  const std::size_t columns = accessor.type == TINYGLTF_TYPE_MAT2   ? 2
                              : accessor.type == TINYGLTF_TYPE_MAT3 ? 3
                              : accessor.type == TINYGLTF_TYPE_MAT4 ? 4
                                                                    : 0;
  return columns == 0 ? elementSize(accessor)
                      : elementSize(accessor) / columns * (columns - 1) + columns * component;
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
    if (!fits(accessor.byteOffset, accessor.count, stride, lastElementSize(accessor), view.byteLength)) {
      gltf.fail(place, std::to_string(accessor.count) + " elements of " + std::to_string(size) +
                           " bytes from byte " + std::to_string(accessor.byteOffset) + " on do not fit the " +
                           std::to_string(view.byteLength) + " bytes of their buffer view");
    }
  }
}

}  // namespace

void checkAccessorLayout(const Gltf& gltf) {
  checkViews(gltf);
  checkAccessors(gltf);
}

}  // namespace promenade::scene
