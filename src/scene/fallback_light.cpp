#include <algorithm>
#include <utility>

#include "src/scene/load.h"

namespace promenade {

bool hasLight(const Scene& scene) {
  if (scene.environment || !scene.lights.empty()) {
    return true;
  }
  return std::any_of(scene.instances.begin(), scene.instances.end(), [&](const Instance& instance) {
    const Material& material = scene.materials[static_cast<std::size_t>(
        scene.meshes[static_cast<std::size_t>(instance.mesh)].material)];
    return material.unlit || material.emission.x > 0.0f || material.emission.y > 0.0f ||
           material.emission.z > 0.0f;
  });
}

Scene ensureLight(Scene scene) {
  if (!hasLight(scene)) {
    scene.environment = Environment{.radiance = RadianceMap(1, 1, Rgb(1.0f))};
    scene.warnings.push_back("the scene has no light: a uniform white sky of radiance 1 is added");
  }
  return scene;
}

}  // namespace promenade
