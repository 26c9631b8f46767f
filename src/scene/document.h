#pragma once
// The JSON of a scene, checked before tinygltf sees it. tinygltf 2.7 recurses on nested JSON, ignores
// extensionsRequired, takes wrongly typed properties for absent ones, truncates 64-bit integers and opens any
// file a URI names. So: size, nesting and types are checked here, files and images are kept from it, and
// `extras` and unsupported extensions too.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/scene/load.h"
#include "src/scene/text.h"

namespace promenade::scene {

struct BufferSource {
  std::optional<std::string> uri;  ///< none: the binary chunk of a GLB
  std::uint64_t byteLength = 0;
};

struct ImageSource {
  std::string name;
  std::string uri;  ///< empty: bufferView
  int bufferView = -1;
};

struct SkinSource {
  std::vector<int> joints;       ///< nodes
  int inverseBindMatrices = -1;  ///< accessor; -1: identity
};

struct Document {
  /// JSON for tinygltf: no buffers, images and skins (it refuses good ones), no extras, only supported
  /// extensions.
  std::string model;
  std::vector<BufferSource> buffers;
  std::vector<ImageSource> images;
  std::vector<SkinSource> skins;
};

/// Throws InputError: not JSON, nested too deeply, not glTF 2, an extension that is required but not
/// supported (named), a property of the wrong type. Unsupported extensions in use become warnings.
[[nodiscard]] Document prepareDocument(std::string_view json, const std::string& source,
                                       const LoadOptions& options, Warnings& warnings);

}  // namespace promenade::scene
