#pragma once
// Internal: what the parts of the loader share while one file is read. Not for inclusion outside
// src/scene/*.cpp.

#include <tiny_gltf.h>

#include <memory>
#include <string>
#include <vector>

#include "src/core/errors.h"
#include "src/scene/budget.h"
#include "src/scene/document.h"
#include "src/scene/files.h"
#include "src/scene/text.h"

namespace promenade::scene {

struct Gltf {
  std::string source;
  tinygltf::Model model;  ///< without buffers and images
  /// Each at least as long as its byteLength; null for a buffer without data.
  std::vector<std::shared_ptr<const Bytes>> buffers;
  std::vector<BufferSource> bufferSources;
  std::vector<ImageSource> images;
  std::vector<SkinSource> skins;

  [[noreturn]] void fail(const std::string& place, const std::string& what) const {
    throw InputError(source, place + ": " + what);
  }
  /// Throws unless 0 <= index < size. `place` names the property, `kind` what it counts.
  void checkIndex(int index, std::size_t size, const std::string& place, const std::string& kind) const {
    if (index < 0 || static_cast<std::size_t>(index) >= size) {
      fail(place,
           "there is no " + kind + " " + std::to_string(index) + ", the file has " + std::to_string(size));
    }
  }
};

[[nodiscard]] inline std::string at(const char* array, std::size_t index) {
  return std::string(array) + '[' + std::to_string(index) + ']';
}

}  // namespace promenade::scene
