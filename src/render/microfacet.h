#pragma once
// The GGX distribution of microfacet normals with Smith's height-correlated masking and shadowing, isotropic,
// in the local frame whose z is the surface normal. All directions are unit and point away from the surface.
//   Walter et al., Microfacet Models for Refraction through Rough Surfaces (EGSR 2007)
//   Heitz, Understanding the Masking-Shadowing Function (JCGT 3(2), 2014)
//   Heitz, Sampling the GGX Distribution of Visible Normals (JCGT 7(4), 2018)
//   Dupuy and Benyoub, Sampling Visible GGX Normals with Spherical Caps (HPG 2023)

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace promenade::render {

/// Surfaces of less (perceptual) roughness are mirrors: alpha 0.0004 is beyond any eye, and the end of
/// float's digits.
inline constexpr float kSmoothRoughness = 0.02f;

/// (1 - x)^5 of Schlick's Fresnel approximation, for x in [0, 1].
inline float schlickWeight(float cosine) {
  const float m = std::clamp(1.0f - cosine, 0.0f, 1.0f);
  const float m2 = m * m;
  return m2 * m2 * m;
}

/// Reflectance at normal incidence of a dielectric; an index of 0 stands for a perfect reflector
/// (KHR_materials_ior).
inline float reflectanceOfIor(float ior) {
  if (ior <= 0.0f) return 1.0f;
  const float r = (ior - 1.0f) / (ior + 1.0f);
  return r * r;
}

class Ggx {
 public:
  explicit Ggx(float alpha) : alpha2_(alpha * alpha), alpha_(alpha) {}

  [[nodiscard]] float alpha() const { return alpha_; }

  /// D(h), per steradian. Written with x^2 + y^2 instead of 1 - z^2, which has no digits left at small alpha.
  [[nodiscard]] float distribution(const glm::vec3& h) const {
    const float t = h.x * h.x + h.y * h.y + alpha2_ * h.z * h.z;
    return alpha2_ / (std::numbers::pi_v<float> * t * t);
  }
  /// G2 / (4 cosOut cosIn), Heitz 2014, eq. 99. Both cosines > 0.
  [[nodiscard]] float visibility(float cosOut, float cosIn) const {
    return 0.5f / (cosIn * root(cosOut) + cosOut * root(cosIn));
  }
  /// G1(o) / (4 cosOut).
  [[nodiscard]] float visibility(float cosOut) const { return 0.5f / (cosOut + root(cosOut)); }
  /// G2 / G1(o): the weight of a visible normal that reflects from cosOut to cosIn.
  [[nodiscard]] float weight(float cosOut, float cosIn) const {
    return cosIn * (cosOut + root(cosOut)) / (cosIn * root(cosOut) + cosOut * root(cosIn));
  }

  /// A normal visible from wo (wo.z > 0), with density 4 visibility(wo.z) D(h) (wo . h).
  [[nodiscard]] glm::vec3 sampleVisibleNormal(const glm::vec3& wo, glm::vec2 u) const {
    const glm::vec3 stretched = glm::normalize(glm::vec3(alpha_ * wo.x, alpha_ * wo.y, wo.z));
    const float phi = 2.0f * std::numbers::pi_v<float> * u.x;
    const float z = (1.0f - u.y) * (1.0f + stretched.z) - stretched.z;
    const float sine = std::sqrt(std::clamp(1.0f - z * z, 0.0f, 1.0f));
    const glm::vec3 h = glm::vec3(sine * std::cos(phi), sine * std::sin(phi), z) + stretched;
    const glm::vec3 unstretched(alpha_ * h.x, alpha_ * h.y, std::max(h.z, 1e-12f));
    return glm::normalize(unstretched);
  }

 private:
  /// cos * sqrt(1 + alpha^2 tan^2).
  [[nodiscard]] float root(float cosine) const {
    return std::sqrt(alpha2_ + (1.0f - alpha2_) * cosine * cosine);
  }

  float alpha2_;
  float alpha_;
};

/// The direction into which `w` is refracted at a facet of normal `h` (w . h > 0) and its cosine with -h;
/// `relativeIor` is that of the far side over that of the side of w. Total reflection: cosine is 0.
struct Refraction {
  glm::vec3 direction{0.0f};
  float cosine = 0.0f;
};

inline Refraction refractThrough(const glm::vec3& w, const glm::vec3& h, float relativeIor) {
  const float inverse = 1.0f / relativeIor;
  const float cosine = glm::dot(w, h);
  const float cosine2 = 1.0f - inverse * inverse * std::max(0.0f, 1.0f - cosine * cosine);
  if (cosine2 <= 0.0f) return {};
  const float far = std::sqrt(cosine2);
  return {h * (inverse * cosine - far) - w * inverse, far};
}

/// Schlick weight of a dielectric boundary: the cosine is that on the side of the smaller index, so that both
/// ways through the boundary have the same reflectance; 1 (and F90 = 1) under total reflection.
inline float boundarySchlickWeight(float cosineHere, float cosineFar, float relativeIor) {
  return schlickWeight(relativeIor >= 1.0f ? cosineHere : cosineFar);
}

}  // namespace promenade::render
