#include "src/render/lights.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "src/render/ray_offset.h"

namespace promenade::render {
namespace {

constexpr float kPi = glm::pi<float>();

float luminance(const Rgb& c) {
  return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}

/// KHR_lights_punctual, "Inner and outer cone angles" and "range": the recommended falloffs.
float coneFalloff(const PunctualLight& light, const glm::vec3& fromLight) {
  const float scale =
      1.0f / std::max(0.001f, std::cos(light.innerConeRadians) - std::cos(light.outerConeRadians));
  const float offset = -std::cos(light.outerConeRadians) * scale;
  const float t = std::clamp(glm::dot(light.direction, fromLight) * scale + offset, 0.0f, 1.0f);
  return t * t;
}

float rangeFalloff(const PunctualLight& light, float distance) {
  if (!std::isfinite(light.rangeMetres)) return 1.0f;
  const float ratio = distance / light.rangeMetres;
  return std::clamp(1.0f - ratio * ratio * ratio * ratio, 0.0f, 1.0f);
}

/// Power over 4 pi sr of mean intensity, scene units: only for choosing between lights.
float power(const PunctualLight& light, float sceneRadius) {
  const float intensity = luminance(light.intensity);
  switch (light.type) {
    case PunctualLight::Type::kPoint:
      return 4.0f * kPi * intensity;
    case PunctualLight::Type::kSpot:
      return 2.0f * kPi * intensity * (1.0f - std::cos(light.outerConeRadians));
    case PunctualLight::Type::kDirectional:
      return kPi * sceneRadius * sceneRadius * intensity;
  }
  return 0.0f;
}

}  // namespace

Lights::Lights(const Surfaces& surfaces, float sceneRadius) : surfaces_(surfaces) {
  const Scene& scene = surfaces.scene();
  std::vector<float> powers;
  firstOfInstance_.assign(scene.instances.size(), -1);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Mesh& mesh = scene.meshes[surfaces.placement(i).mesh];
    const Material& material = surfaces.materialOf(i);
    if (material.unlit || !(luminance(material.emission) > 0.0f)) continue;
    firstOfInstance_[i] = static_cast<std::int64_t>(lightOfTriangle_.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const Surfaces::Corners c = surfaces.corners(i, t);
      const float area = 0.5f * glm::length(c.frontNormal);
      const float sides = material.doubleSided ? 2.0f : 1.0f;
      const float p = kPi * sides * area * surfaces.meanEmission(static_cast<std::uint32_t>(i), t);
      if (!(p > 0.0f) || !std::isfinite(p)) {
        lightOfTriangle_.push_back(-1);
        continue;
      }
      lightOfTriangle_.push_back(static_cast<std::int32_t>(lights_.size()));
      lights_.push_back({static_cast<std::uint32_t>(i), t, 0.0f});
      powers.push_back(p);
    }
  }
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const float p = power(scene.lights[i], sceneRadius);
    if (!(p > 0.0f) || !std::isfinite(p)) continue;
    lights_.push_back({kPunctual, static_cast<std::uint32_t>(i), 0.0f});
    powers.push_back(p);
  }
  double total = 0.0;
  for (const float p : powers) total += p;
  double sum = 0.0;
  cumulative_.reserve(powers.size());
  for (std::size_t i = 0; i < powers.size(); ++i) {
    lights_[i].probability = static_cast<float>(powers[i] / total);
    sum += powers[i];
    cumulative_.push_back(static_cast<float>(sum / total));
  }
}

std::optional<LightSample> Lights::sample(const glm::vec3& position, float choose, glm::vec2 u) const {
  if (lights_.empty()) return std::nullopt;
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), choose);
  const std::size_t index =
      std::min(static_cast<std::size_t>(found - cumulative_.begin()), lights_.size() - 1);
  const Light& light = lights_[index];
  if (light.instance == kPunctual) {
    return samplePunctual(surfaces_.scene().lights[light.index], light.probability, position);
  }
  return sampleTriangle(light, position, u);
}

std::optional<LightSample> Lights::sampleTriangle(const Light& light, const glm::vec3& position,
                                                  glm::vec2 u) const {
  // Uniform over the area: PBRT 4th ed., 6.5.4, SampleUniformTriangle.
  glm::vec2 barycentric;
  if (u.x < u.y) {
    const float a = 0.5f * u.x;
    barycentric = {a, u.y - a};
  } else {
    const float b = 0.5f * u.y;
    barycentric = {u.x - b, b};
  }
  const Surfaces::Corners c = surfaces_.corners(light.instance, light.index);
  const float doubleArea = glm::length(c.frontNormal);
  const glm::vec3 normal = c.frontNormal / doubleArea;
  const float first = 1.0f - barycentric.x - barycentric.y;
  const glm::vec3 point = first * c.a + barycentric.x * c.b + barycentric.y * c.c;
  const glm::vec3 toLight = point - position;
  const float squared = glm::dot(toLight, toLight);
  if (!(squared > 0.0f)) return std::nullopt;
  const float distance = std::sqrt(squared);
  LightSample s;
  s.direction = toLight / distance;
  const float cosine = -glm::dot(normal, s.direction);
  if (std::abs(cosine) < 1e-6f || (cosine < 0.0f && !surfaces_.materialOf(light.instance).doubleSided)) {
    return std::nullopt;
  }
  s.radiance = surfaces_.emissionAt(light.instance, light.index, barycentric);
  if (s.radiance == Rgb(0.0f)) return std::nullopt;
  s.target = offsetRayOrigin(point, cosine > 0.0f ? normal : -normal);
  s.pdf = light.probability * squared / (0.5f * doubleArea * std::abs(cosine));
  return s;
}

std::optional<LightSample> Lights::samplePunctual(const PunctualLight& light, float probability,
                                                  const glm::vec3& position) const {
  LightSample s;
  s.delta = true;
  s.pdf = probability;
  if (light.type == PunctualLight::Type::kDirectional) {
    s.direction = -light.direction;
    s.atInfinity = true;
    s.radiance = light.intensity;
    return s;
  }
  const glm::vec3 toLight = light.position - position;
  const float squared = glm::dot(toLight, toLight);
  if (!(squared > 0.0f)) return std::nullopt;
  const float distance = std::sqrt(squared);
  s.direction = toLight / distance;
  s.target = light.position;
  float falloff = rangeFalloff(light, distance) / squared;
  if (light.type == PunctualLight::Type::kSpot) falloff *= coneFalloff(light, -s.direction);
  if (!(falloff > 0.0f)) return std::nullopt;
  s.radiance = light.intensity * falloff;
  return s;
}

float Lights::pdf(std::uint32_t instance, std::uint32_t triangle, const glm::vec3& direction,
                  float distance) const {
  if (firstOfInstance_.empty() || firstOfInstance_[instance] < 0) return 0.0f;
  const std::int32_t index =
      lightOfTriangle_[static_cast<std::size_t>(firstOfInstance_[instance]) + triangle];
  if (index < 0) return 0.0f;
  const Light& light = lights_[static_cast<std::size_t>(index)];
  const Surfaces::Corners c = surfaces_.corners(instance, triangle);
  const float doubleArea = glm::length(c.frontNormal);
  const float cosine = std::abs(glm::dot(c.frontNormal, direction)) / doubleArea;
  if (!(cosine > 1e-6f)) return 0.0f;
  return light.probability * distance * distance / (0.5f * doubleArea * cosine);
}

}  // namespace promenade::render
