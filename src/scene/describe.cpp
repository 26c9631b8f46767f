#include "src/scene/describe.h"

#include <algorithm>
#include <cstdio>
#include <glm/common.hpp>

namespace promenade {
namespace {

bool isEmissive(const Material& material) {
  return material.unlit || material.emission.x > 0.0f || material.emission.y > 0.0f ||
         material.emission.z > 0.0f;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string triple(const glm::vec3& v) {
  char text[96];
  std::snprintf(text, sizeof text, "(%.4g, %.4g, %.4g)", static_cast<double>(v.x), static_cast<double>(v.y),
                static_cast<double>(v.z));
  return text;
}

std::string counted(std::uint64_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

std::string named(const std::string& name) {
  std::string text = name.empty() ? "(unnamed)" : "\"";
  return name.empty() ? text : text.append(name).append("\"");
}

std::string describeMaterial(const Material& material) {
  std::string line = "material " + named(material.name) + ": base colour " +
                     triple(glm::vec3(material.baseColor)) +
                     (material.baseColorTexture ? " with texture" : "") + ", metallic " +
                     number(material.metallic) + ", roughness " + number(material.roughness);
  if (material.transmission > 0.0f) {
    line += ", transmission " + number(material.transmission) + " (ior " + number(material.ior) + ")";
  }
  if (material.clearcoat > 0.0f) {
    line += ", clearcoat " + number(material.clearcoat);
  }
  if (isEmissive(material)) {
    line += material.unlit ? ", unlit" : ", emits " + triple(material.emission);
  }
  if (material.alphaMode != AlphaMode::kOpaque) {
    line += material.alphaMode == AlphaMode::kMask ? ", alpha mask" : ", alpha blend";
  }
  return line + (material.doubleSided ? ", double-sided" : "");
}

std::string describeLight(const PunctualLight& light) {
  switch (light.type) {
    case PunctualLight::Type::kPoint:
      return "point light " + named(light.name) + ": " + triple(light.intensity) + " cd at " +
             triple(light.position);
    case PunctualLight::Type::kSpot:
      return "spot light " + named(light.name) + ": " + triple(light.intensity) + " cd at " +
             triple(light.position) + " toward " + triple(light.direction);
    case PunctualLight::Type::kDirectional:
      return "directional light " + named(light.name) + ": " + triple(light.intensity) + " lx toward " +
             triple(light.direction);
  }
  return {};
}

/// Last key time of all tracks of an animation.
float duration(const CameraAnimation& animation) {
  float last = 0.0f;
  const auto take = [&last](const auto& track) {
    if (track && !track->times.empty()) {
      last = std::max(last, track->times.back());
    }
  };
  for (const AnimatedNode& node : animation.rootToCamera) {
    take(node.translationTrack);
    take(node.rotationTrack);
    take(node.scaleTrack);
  }
  return last;
}

bool isAnimated(const CameraAnimation& camera) {
  return std::any_of(camera.rootToCamera.begin(), camera.rootToCamera.end(), [](const AnimatedNode& node) {
    return node.translationTrack || node.rotationTrack || node.scaleTrack;
  });
}

std::string describeCamera(const CameraAnimation& camera) {
  constexpr double kDegreesPerRadian = 57.29577951308232;
  const std::string view = named(camera.cameraName) + ", vertical field of view " +
                           number(camera.verticalFieldOfView * kDegreesPerRadian) + " degrees";
  return isAnimated(camera) ? "camera animation " + named(camera.name) + ": camera " + view + ", " +
                                  number(duration(camera)) + " s"
                            : "camera " + view + ", at rest";
}

}  // namespace

std::optional<Bounds> worldBounds(const Scene& scene) {
  std::vector<std::optional<Bounds>> ofMesh;
  for (const Mesh& mesh : scene.meshes) {
    std::optional<Bounds>& bounds = ofMesh.emplace_back();
    for (const glm::vec3& position : mesh.positions) {
      bounds = bounds ? Bounds{glm::min(bounds->low, position), glm::max(bounds->high, position)}
                      : Bounds{position, position};
    }
  }
  std::optional<Bounds> world;
  for (const Instance& instance : scene.instances) {
    const std::optional<Bounds>& local = ofMesh[static_cast<std::size_t>(instance.mesh)];
    if (!local) {
      continue;
    }
    for (int corner = 0; corner < 8; ++corner) {
      const glm::vec3 point((corner & 1) != 0 ? local->high.x : local->low.x,
                            (corner & 2) != 0 ? local->high.y : local->low.y,
                            (corner & 4) != 0 ? local->high.z : local->low.z);
      const glm::vec3 placed = instance.worldFromObject * glm::vec4(point, 1.0f);
      world = world ? Bounds{glm::min(world->low, placed), glm::max(world->high, placed)}
                    : Bounds{placed, placed};
    }
  }
  return world;
}

SceneSummary summarize(const Scene& scene) {
  SceneSummary summary;
  summary.meshes = scene.meshes.size();
  for (const Mesh& mesh : scene.meshes) {
    summary.storedTriangles += mesh.triangles.size();
  }
  summary.instances = scene.instances.size();
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
    summary.placedTriangles += mesh.triangles.size();
    summary.emissiveInstances += isEmissive(scene.materials[static_cast<std::size_t>(mesh.material)]) ? 1 : 0;
  }
  summary.materials = scene.materials.size();
  summary.images = scene.images.size();
  for (const TextureImage& image : scene.images) {
    summary.texelBytes += image.size.area() * 4;
  }
  summary.punctualLights = scene.lights.size();
  summary.hasEnvironment = scene.environment.has_value();
  for (const CameraAnimation& camera : scene.cameras) {
    ++(isAnimated(camera) ? summary.cameraAnimations : summary.camerasAtRest);
  }
  summary.worldBounds = worldBounds(scene);
  return summary;
}

std::vector<std::string> describe(const Scene& scene) {
  const SceneSummary summary = summarize(scene);
  std::vector<std::string> lines;
  lines.push_back(scene.source);
  lines.push_back(counted(summary.meshes, "mesh", "meshes") + " with " +
                  counted(summary.storedTriangles, "triangle", "triangles") + ", " +
                  counted(summary.instances, "instance", "instances") + " with " +
                  counted(summary.placedTriangles, "triangle", "triangles"));
  if (summary.worldBounds) {
    lines.push_back("from " + triple(summary.worldBounds->low) + " to " + triple(summary.worldBounds->high) +
                    " metres");
  }
  lines.push_back(counted(summary.materials, "material", "materials") + ", " +
                  counted(summary.images, "image", "images") + " of " +
                  number(static_cast<double>(summary.texelBytes) / 1048576.0) + " MiB decoded");
  lines.push_back(counted(summary.punctualLights, "punctual light", "punctual lights") + ", " +
                  counted(summary.emissiveInstances, "emissive instance", "emissive instances") +
                  (summary.hasEnvironment ? ", an environment" : ", no environment"));
  lines.push_back(counted(summary.camerasAtRest, "camera", "cameras") + ", " +
                  counted(summary.cameraAnimations, "camera animation", "camera animations"));
  for (const Material& material : scene.materials) {
    lines.push_back(describeMaterial(material));
  }
  for (const TextureImage& image : scene.images) {
    lines.push_back("image " + named(image.name) + ": " + std::to_string(image.size.width) + " x " +
                    std::to_string(image.size.height));
  }
  for (const PunctualLight& light : scene.lights) {
    lines.push_back(describeLight(light));
  }
  for (const CameraAnimation& camera : scene.cameras) {
    lines.push_back(describeCamera(camera));
  }
  for (const std::string& warning : scene.warnings) {
    lines.push_back("warning: " + warning);
  }
  return lines;
}

}  // namespace promenade
