#pragma once
// What a scene holds, in numbers and lines: for `promenade info`.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/scene/scene.h"

namespace promenade {

struct Bounds {
  glm::vec3 low{0.0f};
  glm::vec3 high{0.0f};
};

struct SceneSummary {
  std::size_t meshes = 0;
  std::uint64_t storedTriangles = 0;  ///< of all meshes
  std::uint64_t placedTriangles = 0;  ///< of all instances
  std::size_t instances = 0;
  std::size_t materials = 0;
  std::size_t images = 0;
  std::uint64_t texelBytes = 0;  ///< decoded, without mip-maps
  std::size_t punctualLights = 0;
  std::size_t emissiveInstances = 0;
  bool hasEnvironment = false;
  std::size_t camerasAtRest = 0;
  std::size_t cameraAnimations = 0;
  std::optional<Bounds> worldBounds;  ///< metres; none without instances
};

/// World-space box around all instances; nothing if there are none.
[[nodiscard]] std::optional<Bounds> worldBounds(const Scene& scene);

[[nodiscard]] SceneSummary summarize(const Scene& scene);

/// The summary, every material, image, light, camera and warning as lines of text, without line breaks in
/// them.
[[nodiscard]] std::vector<std::string> describe(const Scene& scene);

}  // namespace promenade
