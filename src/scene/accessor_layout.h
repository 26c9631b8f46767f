#pragma once
// Internal: where the elements of accessors lie, and the proof that they lie within their buffers.

#include <cstddef>

#include "src/scene/gltf.h"

namespace promenade::scene {

/// 0 for a component type that glTF does not have.
[[nodiscard]] std::size_t componentSize(int type);
/// Bytes of one element, with the padding of matrix columns to 4 bytes (glTF 2.0, 3.6.2.4).
[[nodiscard]] std::size_t elementSize(const tinygltf::Accessor& accessor);
/// Unsigned integers.
[[nodiscard]] bool isIndexType(int type);

/// Checks every buffer view and accessor of the file: component types, strides, and that each element lies
/// within its view and each view within its buffer. Throws InputError.
void checkAccessorLayout(const Gltf& gltf);

}  // namespace promenade::scene
