#include "src/render/albedo_tables.h"

#include "src/render/microfacet.h"

namespace promenade::render {
namespace {

constexpr int kSamples = 1024;
constexpr int kBoundarySamples = 256;

/// Points of a two-dimensional additive recurrence (Roberts 2018): even, and the same on every machine.
glm::vec2 quadraturePoint(int i) {
  const double x = 0.5 + 0.7548776662466927 * i;
  const double y = 0.5 + 0.5698402909980532 * i;
  return {static_cast<float>(x - std::floor(x)), static_cast<float>(y - std::floor(y))};
}

/// Position of a value in a table axis of `count` entries: the entry below and the fraction towards the next.
struct Position {
  std::size_t index;
  float fraction;
};

Position positionIn(float unit, std::size_t count) {
  const float scaled = std::clamp(unit, 0.0f, 1.0f) * static_cast<float>(count - 1);
  const auto index = std::min(static_cast<std::size_t>(scaled), count - 2);
  return {index, scaled - static_cast<float>(index)};
}

float unitOf(std::size_t index, std::size_t count) {
  return static_cast<float>(index) / static_cast<float>(count - 1);
}

// Entries are denser towards grazing angles, where the albedo changes fastest.
float cosineOf(std::size_t index, std::size_t count) {
  const float unit = unitOf(index, count);
  return std::max(unit * unit, 1e-5f);
}

glm::vec3 directionOf(float cosine) {
  return {std::sqrt(1.0f - cosine * cosine), 0.0f, cosine};
}

SpecularAlbedo mix(const SpecularAlbedo& a, const SpecularAlbedo& b, float t) {
  return {a.scale + (b.scale - a.scale) * t, a.bias + (b.bias - a.bias) * t};
}

SpecularAlbedo integrateReflection(float cosine, float roughness) {
  if (roughness == 0.0f) return {1.0f - schlickWeight(cosine), schlickWeight(cosine)};
  const Ggx ggx(roughness * roughness);
  const glm::vec3 wo = directionOf(cosine);
  double whole = 0.0;
  double bias = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const glm::vec3 h = ggx.sampleVisibleNormal(wo, quadraturePoint(i));
    const float cosHalf = glm::dot(wo, h);
    const float cosIn = 2.0f * cosHalf * h.z - wo.z;
    if (cosIn <= 0.0f) continue;
    const float weight = ggx.weight(wo.z, cosIn);
    whole += weight;
    bias += weight * schlickWeight(cosHalf);
  }
  return {static_cast<float>((whole - bias) / kSamples), static_cast<float>(bias / kSamples)};
}

float integrateBoundary(float cosine, float roughness, float relativeIor) {
  if (roughness == 0.0f) return 1.0f;
  const Ggx ggx(roughness * roughness);
  const glm::vec3 wo = directionOf(cosine);
  const float f0 = reflectanceOfIor(relativeIor);
  double sum = 0.0;
  for (int i = 0; i < kBoundarySamples; ++i) {
    const glm::vec3 h = ggx.sampleVisibleNormal(wo, quadraturePoint(i));
    const float cosHalf = glm::dot(wo, h);
    const Refraction refraction = refractThrough(wo, h, relativeIor);
    const float fresnel =
        refraction.cosine > 0.0f
            ? f0 + (1.0f - f0) * boundarySchlickWeight(cosHalf, refraction.cosine, relativeIor)
            : 1.0f;
    const float cosReflected = 2.0f * cosHalf * h.z - wo.z;
    if (cosReflected > 0.0f) sum += fresnel * ggx.weight(wo.z, cosReflected);
    if (refraction.direction.z < 0.0f) sum += (1.0f - fresnel) * ggx.weight(wo.z, -refraction.direction.z);
  }
  return static_cast<float>(sum / kBoundarySamples);
}

// The index of refraction runs over (n - 1) / (n + 1) in [-1/2, 1/2]: even in the normal reflectance's root.
float iorOf(std::size_t index, std::size_t count) {
  const float x = unitOf(index, count) - 0.5f;
  return (1.0f + x) / (1.0f - x);
}

}  // namespace

SpecularAlbedoTable::SpecularAlbedoTable() {
  for (std::size_t r = 0; r < kRoughnesses; ++r) {
    for (std::size_t c = 0; c < kCosines; ++c) {
      directional_[r][c] = integrateReflection(cosineOf(c, kCosines), unitOf(r, kRoughnesses));
    }
  }
  // The mean of the interpolated table itself, so that what one direction gives up all directions get back.
  constexpr int kSteps = 512;
  for (std::size_t r = 0; r < kRoughnesses; ++r) {
    double scale = 0.0;
    double bias = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const float cosine = (static_cast<float>(i) + 0.5f) / kSteps;
      const SpecularAlbedo albedo = directional(cosine, unitOf(r, kRoughnesses));
      scale += 2.0 * cosine * albedo.scale / kSteps;
      bias += 2.0 * cosine * albedo.bias / kSteps;
    }
    average_[r] = {static_cast<float>(scale), static_cast<float>(bias)};
  }
}

SpecularAlbedo SpecularAlbedoTable::directional(float cosine, float roughness) const {
  const Position r = positionIn(roughness, kRoughnesses);
  const Position c = positionIn(std::sqrt(std::clamp(cosine, 0.0f, 1.0f)), kCosines);
  const auto& low = directional_[r.index];
  const auto& high = directional_[r.index + 1];
  return mix(mix(low[c.index], low[c.index + 1], c.fraction),
             mix(high[c.index], high[c.index + 1], c.fraction), r.fraction);
}

SpecularAlbedo SpecularAlbedoTable::average(float roughness) const {
  const Position r = positionIn(roughness, kRoughnesses);
  return mix(average_[r.index], average_[r.index + 1], r.fraction);
}

BoundaryAlbedoTable::BoundaryAlbedoTable() : values_(kIors * kRoughnesses * kCosines) {
  for (std::size_t i = 0; i < kIors; ++i) {
    for (std::size_t r = 0; r < kRoughnesses; ++r) {
      for (std::size_t c = 0; c < kCosines; ++c) {
        values_[(i * kRoughnesses + r) * kCosines + c] =
            integrateBoundary(cosineOf(c, kCosines), unitOf(r, kRoughnesses), iorOf(i, kIors));
      }
    }
  }
}

float BoundaryAlbedoTable::directional(float cosine, float roughness, float relativeIor) const {
  const Position i = positionIn((relativeIor - 1.0f) / (relativeIor + 1.0f) + 0.5f, kIors);
  const Position r = positionIn(roughness, kRoughnesses);
  const Position c = positionIn(std::sqrt(std::clamp(cosine, 0.0f, 1.0f)), kCosines);
  const auto alongCosine = [&](std::size_t ior, std::size_t roughnessIndex) {
    return std::lerp(at(ior, roughnessIndex, c.index), at(ior, roughnessIndex, c.index + 1), c.fraction);
  };
  const auto alongRoughness = [&](std::size_t ior) {
    return std::lerp(alongCosine(ior, r.index), alongCosine(ior, r.index + 1), r.fraction);
  };
  return std::lerp(alongRoughness(i.index), alongRoughness(i.index + 1), i.fraction);
}

const SpecularAlbedoTable& specularAlbedoTable() {
  static const SpecularAlbedoTable table;
  return table;
}

const BoundaryAlbedoTable& boundaryAlbedoTable() {
  static const BoundaryAlbedoTable table;
  return table;
}

}  // namespace promenade::render
