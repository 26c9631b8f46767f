#pragma once
// Limits and permissions of the scene loader, as options of every verb that reads a scene.

#include <string>

#include "src/scene/load.h"

namespace promenade::app {

/// As typed; empty: the default.
struct SceneOptions {
  bool allowOutsideFolder = false;
  std::string textureMemory = "1024";
  std::string maxFileBytes, maxJsonBytes, maxTextureBytes, maxGeometryBytes, maxTriangles, maxInstances,
      maxExpansion;
};

/// Throws InputError for what is no whole number above 0.
[[nodiscard]] LoadOptions loadOptions(const SceneOptions& options);

}  // namespace promenade::app
