#include "src/app/scene_options.h"

#include "src/app/values.h"

namespace promenade::app {

LoadOptions loadOptions(const SceneOptions& options) {
  LoadOptions result;
  if (options.allowOutsideFolder) result.fileAccess = FileAccess::kAnywhere;
  result.textureMegabytes = integerFrom(options.textureMemory, 10, 1 << 24, "--texture-memory");
  const auto set = [](std::uint64_t& limit, const std::string& text, const char* option) {
    // Doubles hold whole numbers exactly up to 2^53, far above any limit that makes sense.
    if (!text.empty()) limit = static_cast<std::uint64_t>(numberFrom(text, 1.0, 9e15, option));
  };
  set(result.maxFileBytes, options.maxFileBytes, "--max-file-bytes");
  set(result.maxJsonBytes, options.maxJsonBytes, "--max-json-bytes");
  set(result.maxTextureBytes, options.maxTextureBytes, "--max-texture-bytes");
  set(result.maxGeometryBytes, options.maxGeometryBytes, "--max-geometry-bytes");
  set(result.maxTriangles, options.maxTriangles, "--max-triangles");
  set(result.maxInstances, options.maxInstances, "--max-instances");
  set(result.maxExpansion, options.maxExpansion, "--max-expansion");
  return result;
}

}  // namespace promenade::app
