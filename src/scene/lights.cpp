#include <glm/geometric.hpp>

#include "src/scene/placement.h"
#include "src/scene/values.h"

namespace promenade::scene {
namespace {

constexpr float kQuarterTurn = 1.57079633f;
constexpr float kBrightest = 1e12f;

/// The light as the file defines it, in its own space.
PunctualLight readLight(const Gltf& gltf, std::size_t index, Warnings& warnings) {
  const tinygltf::Light& source = gltf.model.lights[index];
  const std::string place = "extensions.KHR_lights_punctual.lights[" + std::to_string(index) + "]";
  PunctualLight light;
  light.name = printable(source.name);
  if (source.type == "point") {
    light.type = PunctualLight::Type::kPoint;
  } else if (source.type == "spot") {
    light.type = PunctualLight::Type::kSpot;
  } else if (source.type == "directional") {
    light.type = PunctualLight::Type::kDirectional;
  } else {
    gltf.fail(place + ".type", "expected point, spot or directional, found " + inQuotes(source.type));
  }
  if (!source.color.empty() && source.color.size() != 3) {
    gltf.fail(place + ".color", "expected 3 numbers, found " + std::to_string(source.color.size()));
  }
  const float intensity = limited(toFloat(gltf, source.intensity, place + ".intensity"), 0.0f, kBrightest,
                                  place + ".intensity", warnings);
  for (int i = 0; i < 3; ++i) {
    const double color = source.color.empty() ? 1.0 : source.color[static_cast<std::size_t>(i)];
    light.intensity[i] = intensity * limited(toFloat(gltf, color, place + ".color"), 0.0f, kBrightest,
                                             place + ".color", warnings);
  }
  if (source.range > 0.0) {  // tinygltf: 0 where the file gives none
    light.rangeMetres = toFloat(gltf, source.range, place + ".range");
  }
  if (light.type == PunctualLight::Type::kSpot) {
    const std::string outer = place + ".spot.outerConeAngle";
    const std::string inner = place + ".spot.innerConeAngle";
    light.outerConeRadians =
        limited(toFloat(gltf, source.spot.outerConeAngle, outer), 1e-3f, kQuarterTurn, outer, warnings);
    light.innerConeRadians = limited(toFloat(gltf, source.spot.innerConeAngle, inner), 0.0f,
                                     light.outerConeRadians, inner, warnings);
  }
  return light;
}

}  // namespace

std::vector<PunctualLight> placeLights(const Gltf& gltf, const std::vector<PlacedNode>& nodes,
                                       Warnings& warnings) {
  std::vector<PunctualLight> lights;
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Node& node = gltf.model.nodes[static_cast<std::size_t>(placed.node)];
    const Fields reference = extension(gltf, node.extensions, "KHR_lights_punctual",
                                       at("nodes", static_cast<std::size_t>(placed.node)));
    if (!reference) {
      continue;
    }
    const int index = reference.index("light", -1);
    gltf.checkIndex(index, gltf.model.lights.size(), reference.place("light"), "light");
    PunctualLight light = readLight(gltf, static_cast<std::size_t>(index), warnings);
    light.position = glm::vec3(placed.worldFromNode[3]);
    // Lights look along -Z of their node; its scale does not matter (KHR_lights_punctual).
    const glm::dvec3 axis = -glm::dvec3(placed.worldFromNode[2]);
    const double length = glm::length(axis);
    if (length > 0.0) {
      light.direction = glm::vec3(axis / length);
    } else if (light.type != PunctualLight::Type::kPoint) {
      gltf.fail(reference.place(), "the node's scale of zero leaves the light without a direction");
    }
    lights.push_back(std::move(light));
  }
  return lights;
}

}  // namespace promenade::scene
