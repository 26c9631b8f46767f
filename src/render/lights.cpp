#include "src/render/lights.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "src/render/maths.h"
#include "src/render/ray_offset.h"

namespace promenade::render {
namespace {

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

LightBounds boundsOf(const PunctualLight& light) {
  LightBounds b;
  b.lower = b.upper = light.position;
  b.intensity = luminance(light.intensity);
  if (light.type == PunctualLight::Type::kSpot) {
    b.axis = light.direction;
    b.cosThetaO = std::cos(light.innerConeRadians);
    b.cosThetaE = std::cos(std::max(light.outerConeRadians - light.innerConeRadians, 1e-3f));
  } else {
    b.cosThetaO = -1.0f;
  }
  return b;
}

LightBounds boundsOf(const Surfaces::Corners& c, float radiance, bool bothSides) {
  const float doubleArea = glm::length(c.frontNormal);
  LightBounds b;
  b.lower = glm::min(c.a, glm::min(c.b, c.c));
  b.upper = glm::max(c.a, glm::max(c.b, c.c));
  b.axis = c.frontNormal / doubleArea;
  b.intensity = 0.5f * doubleArea * radiance;
  b.bothSides = bothSides;
  return b;
}

bool isUsable(const LightBounds& b) {
  return b.intensity > 0.0f && std::isfinite(b.intensity);
}

}  // namespace

Lights::Lights(const Surfaces& surfaces) : surfaces_(surfaces), tree_({}) {
  const Scene& scene = surfaces.scene();
  std::vector<LightBounds> bounds;
  firstOfInstance_.assign(scene.instances.size(), -1);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Mesh& mesh = scene.meshes[surfaces.placement(i).mesh];
    const Material& material = surfaces.materialOf(i);
    if (material.unlit || !(luminance(material.emission) > 0.0f)) continue;
    firstOfInstance_[i] = static_cast<std::int64_t>(lightOfTriangle_.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const LightBounds b =
          boundsOf(surfaces.corners(i, t), surfaces.meanEmission(static_cast<std::uint32_t>(i), t),
                   material.doubleSided);
      if (!isUsable(b)) {
        lightOfTriangle_.push_back(-1);
        continue;
      }
      lightOfTriangle_.push_back(static_cast<std::int32_t>(lights_.size()));
      lights_.push_back({static_cast<std::uint32_t>(i), t});
      bounds.push_back(b);
    }
  }
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const PunctualLight& light = scene.lights[i];
    const LightBounds b = boundsOf(light);
    if (!isUsable(b)) continue;
    if (light.type == PunctualLight::Type::kDirectional) {
      directional_.push_back(static_cast<std::uint32_t>(i));
    } else {
      lights_.push_back({kPunctual, static_cast<std::uint32_t>(i)});
      bounds.push_back(b);
    }
  }
  tree_ = LightTree(bounds);
  if (!directional_.empty()) directionalShare_ = lights_.empty() ? 1.0f : 0.5f;
}

template <class ChooseFrom>
std::optional<LightSample> Lights::sampleAt(const glm::vec3& position, float choose, glm::vec2 u,
                                            const ChooseFrom& chooseFrom) const {
  if (choose < directionalShare_) {
    const auto count = static_cast<float>(directional_.size());
    const auto index =
        std::min(static_cast<std::size_t>(choose / directionalShare_ * count), directional_.size() - 1);
    return samplePunctual(surfaces_.scene().lights[directional_[index]], directionalShare_ / count, position);
  }
  const float rest = 1.0f - directionalShare_;
  const std::optional<LightTree::Choice> choice =
      chooseFrom(std::min((choose - directionalShare_) / rest, 0.99999994f));
  if (!choice) return std::nullopt;
  const Light& light = lights_[choice->light];
  const float probability = choice->probability * rest;
  if (light.instance == kPunctual) {
    return samplePunctual(surfaces_.scene().lights[light.index], probability, position);
  }
  return sampleTriangle(light, probability, position, u);
}

std::optional<LightSample> Lights::sample(const glm::vec3& position, const glm::vec3& normal, float choose,
                                          glm::vec2 u) const {
  return sampleAt(position, choose, u, [&](float v) { return tree_.choose(position, normal, v); });
}

std::optional<LightSample> Lights::sample(LightTree::View& view, float choose, glm::vec2 u) const {
  return sampleAt(view.position(), choose, u, [&view](float v) { return view.choose(v); });
}

std::optional<LightSample> Lights::sampleTriangle(const Light& light, float probability,
                                                  const glm::vec3& position, glm::vec2 u) const {
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
  s.pdf = probability * squared / (0.5f * doubleArea * std::abs(cosine));
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

float Lights::pdf(const Found& found, const glm::vec3& position, const glm::vec3& normal) const {
  const std::int64_t first = firstOfInstance_[found.instance];
  if (first < 0) return 0.0f;
  const std::int32_t light = lightOfTriangle_[static_cast<std::size_t>(first) + found.triangle];
  if (light < 0) return 0.0f;
  const glm::vec3 frontNormal = surfaces_.corners(found.instance, found.triangle).frontNormal;
  const float doubleArea = glm::length(frontNormal);
  const float cosine = std::abs(glm::dot(frontNormal, found.direction)) / doubleArea;
  if (!(cosine > 1e-6f)) return 0.0f;
  const float probability =
      tree_.probability(static_cast<std::uint32_t>(light), position, normal) * (1.0f - directionalShare_);
  return probability * found.distance * found.distance / (0.5f * doubleArea * cosine);
}

}  // namespace promenade::render
