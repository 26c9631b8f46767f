#include "src/render/albedo_tables.h"

#include "src/render/maths.h"
#include "src/render/microfacet.h"

namespace promenade::render {
namespace {

/// Midpoint rule over the two numbers that choose a visible normal. The view lies in the xz plane, so half a
/// turn of azimuths stands for both halves; the integrands are even and smooth there, and few azimuths are
/// enough. The second number is 1 - t^power: a power above 1 puts points where facets are steep and
/// reflections go below the horizon.
struct Quadrature {
  int azimuths;
  int heights;
  int power;
  struct Point {
    glm::vec2 u;
    float weight;
  };
  [[nodiscard]] int count() const { return azimuths * heights; }
  [[nodiscard]] Point point(int i) const {
    const float azimuth = (static_cast<float>(i % azimuths) + 0.5f) / static_cast<float>(2 * azimuths);
    const float t = (static_cast<float>(i / azimuths) + 0.5f) / static_cast<float>(heights);
    float slope = 1.0f;
    for (int k = 1; k < power; ++k) slope *= t;
    return {{azimuth, 1.0f - slope * t}, static_cast<float>(power) * slope / static_cast<float>(count())};
  }
};

constexpr Quadrature kReflectionQuadrature{24, 32, 3};
constexpr Quadrature kBoundaryQuadrature{16, 40, 2};

/// On which side of the boundary the light is seen from.
enum class BoundarySide { kThinner, kDenser };

float unitOf(std::size_t index, std::size_t count) {
  return static_cast<float>(index) / static_cast<float>(count - 1);
}

// Smoother surfaces than kSmoothRoughness are not looked up. The axis is the root of the roughness: the scale
// of things is alpha, its fourth power, and entries should not be many times apart.
float alphaAt(float roughness) {
  return roughness * roughness;
}

float roughnessCoordinate(float roughness) {
  const float least = std::sqrt(kSmoothRoughness);
  return (std::sqrt(std::max(roughness, kSmoothRoughness)) - least) / (1.0f - least);
}

float roughnessOf(std::size_t index, std::size_t count) {
  const float least = std::sqrt(kSmoothRoughness);
  const float root = least + (1.0f - least) * unitOf(index, count);
  return std::clamp(root * root, kSmoothRoughness, 1.0f);
}

constexpr float kSmallestCosine = 1e-6f;

float cosineAtMasking(float coordinate, float alpha) {
  const float c2 = coordinate * coordinate;
  return std::clamp(alpha * c2 / (1.0f + alpha - c2), kSmallestCosine, 1.0f);
}

float cosineAtFresnel(float coordinate) {
  return std::max(coordinate * coordinate, kSmallestCosine);
}

float mix(float a, float b, float t) {
  return a + (b - a) * t;
}

SpecularAlbedo integrateReflection(float cosine, float roughness) {
  const Ggx ggx(alphaAt(roughness));
  const glm::vec3 wo = directionAt(cosine);
  double whole = 0.0;
  double bias = 0.0;
  double weights = 0.0;
  for (int i = 0; i < kReflectionQuadrature.count(); ++i) {
    const Quadrature::Point point = kReflectionQuadrature.point(i);
    weights += point.weight;
    const glm::vec3 h = ggx.sampleVisibleNormal(wo, point.u);
    const float cosHalf = glm::dot(wo, h);
    const float cosIn = 2.0f * cosHalf * h.z - wo.z;
    if (cosIn <= 0.0f) continue;
    const float weight = point.weight * ggx.weight(wo.z, cosIn);
    whole += weight;
    bias += weight * schlickWeight(cosHalf);
  }
  return {static_cast<float>((whole - bias) / weights), static_cast<float>(bias / weights)};
}

float integrateBoundary(float cosine, float roughness, float relativeIor) {
  const Ggx ggx(alphaAt(roughness));
  const glm::vec3 wo = directionAt(cosine);
  const float f0 = reflectanceOfIor(relativeIor);
  double sum = 0.0;
  double weights = 0.0;
  for (int i = 0; i < kBoundaryQuadrature.count(); ++i) {
    const Quadrature::Point point = kBoundaryQuadrature.point(i);
    weights += point.weight;
    const glm::vec3 h = ggx.sampleVisibleNormal(wo, point.u);
    const float cosHalf = glm::dot(wo, h);
    const Refraction refraction = refractThrough(wo, h, relativeIor);
    const float fresnel =
        refraction.cosine > 0.0f
            ? f0 + (1.0f - f0) * boundarySchlickWeight(cosHalf, refraction.cosine, relativeIor)
            : 1.0f;
    const float cosReflected = 2.0f * cosHalf * h.z - wo.z;
    float through = 0.0f;
    if (cosReflected > 0.0f) through += fresnel * ggx.weight(wo.z, cosReflected);
    if (refraction.direction.z < 0.0f)
      through += (1.0f - fresnel) * ggx.weight(wo.z, -refraction.direction.z);
    sum += point.weight * through;
  }
  return static_cast<float>(sum / weights);
}

// Where total reflection begins moves like the root of n - 1, and so does this axis, from 1 to 3 (or 1 / 3);
// the two sides of 1 are tables of their own, because nothing is smooth across it.
float iorCoordinate(float relativeIor) {
  return std::sqrt(2.0f * std::abs(relativeIor - 1.0f) / (relativeIor + 1.0f));
}

float iorOf(std::size_t index, std::size_t count, BoundarySide side) {
  const float coordinate = std::max(unitOf(index, count), 1e-2f);
  const float x = 0.5f * coordinate * coordinate;
  const float ior = (1.0f + x) / (1.0f - x);
  return side == BoundarySide::kThinner ? ior : 1.0f / ior;
}

}  // namespace

SpecularAlbedoTable::SpecularAlbedoTable() : average_{} {
  for (std::size_t r = 0; r < kRoughnesses; ++r) {
    const float roughness = roughnessOf(r, kRoughnesses);
    for (std::size_t c = 0; c < kCosines; ++c) {
      const float unit = unitOf(c, kCosines);
      whole_[r * kCosines + c] =
          integrateReflection(cosineAtMasking(unit, alphaAt(roughness)), roughness).whole();
      const float cosine = cosineAtFresnel(unit);
      const SpecularAlbedo albedo = integrateReflection(cosine, roughness);
      biasShare_[r * kCosines + c] = albedo.bias / albedo.whole() - schlickWeight(cosine);
    }
  }
  // The means of the interpolated table itself, so that what one direction gives up all directions get back.
  // More roughnesses than above: what smooth surfaces lose in the mean is small, and its share of error must
  // be too.
  constexpr int kSteps = 400;
  for (std::size_t r = 0; r < kAverages; ++r) {
    const Row row = at(roughnessOf(r, kAverages));
    double scale = 0.0;
    double bias = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      // 2 c dc with c = t^3: dense where smooth surfaces lose.
      const double t = (i + 0.5) / kSteps;
      const double weight = 6.0 * t * t * t * t * t / kSteps;
      const SpecularAlbedo albedo = row.directional(static_cast<float>(t * t * t));
      scale += weight * albedo.scale;
      bias += weight * albedo.bias;
    }
    average_[r] = {static_cast<float>(scale), static_cast<float>(bias)};
  }
}

SpecularAlbedoTable::Row SpecularAlbedoTable::at(float roughness) const {
  Row row;
  if (roughness < kSmoothRoughness) return row;
  const float coordinate = roughnessCoordinate(roughness);
  const TablePosition r = TablePosition::on(coordinate, kRoughnesses);
  row.whole_ = whole_.data() + r.index * kCosines;
  row.biasShare_ = biasShare_.data() + r.index * kCosines;
  row.fraction_ = r.fraction;
  row.alpha_ = alphaAt(roughness);
  const TablePosition a = TablePosition::on(coordinate, kAverages);
  const SpecularAlbedo& low = average_[a.index];
  const SpecularAlbedo& high = average_[a.index + 1];
  row.average_ = {mix(low.scale, high.scale, a.fraction), mix(low.bias, high.bias, a.fraction)};
  return row;
}

BoundaryAlbedoTable::BoundaryAlbedoTable() {
  for (const BoundarySide side : {BoundarySide::kThinner, BoundarySide::kDenser}) {
    for (std::size_t i = 0; i < kIors; ++i) {
      for (std::size_t r = 0; r < kRoughnesses; ++r) {
        const float roughness = roughnessOf(r, kRoughnesses);
        for (std::size_t c = 0; c < kCosines; ++c) {
          const float cosine = cosineAtMasking(unitOf(c, kCosines), alphaAt(roughness));
          values_.push_back(integrateBoundary(cosine, roughness, iorOf(i, kIors, side)));
        }
      }
    }
  }
}

float BoundaryAlbedoTable::directional(float cosine, float roughness, float relativeIor) const {
  const float alpha = alphaAt(std::max(roughness, kSmoothRoughness));
  const std::size_t side = relativeIor >= 1.0f ? 0 : kIors;
  const TablePosition i = TablePosition::on(iorCoordinate(relativeIor), kIors);
  const TablePosition r = TablePosition::on(roughnessCoordinate(roughness), kRoughnesses);
  const TablePosition c = TablePosition::on(SpecularAlbedoTable::maskingCoordinate(cosine, alpha), kCosines);
  const auto alongCosine = [&](std::size_t ior, std::size_t roughnessIndex) {
    const std::size_t entry = (ior * kRoughnesses + roughnessIndex) * kCosines + c.index;
    return mix(values_[entry], values_[entry + 1], c.fraction);
  };
  const auto alongRoughness = [&](std::size_t ior) {
    return mix(alongCosine(ior, r.index), alongCosine(ior, r.index + 1), r.fraction);
  };
  return mix(alongRoughness(side + i.index), alongRoughness(side + i.index + 1), i.fraction);
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
