// glTF 2.0, appendix B (metallic-roughness), with KHR_materials_ior, _specular, _clearcoat, _transmission,
// _volume. Departures, all for the sake of energy conservation:
// - Masked light is given back: a diffuse-like lobe of the missing energy for reflection and for thin walls
// (Kulla and
//   Conty, Revisiting Physically Based Shading at Imageworks, SIGGRAPH 2017 course), a scaling of the lobes
//   by one over their albedo for refracting boundaries (Turquin, Practical Multiple Scattering Compensation,
//   2019), which is not reciprocal.
// - Diffuse light under the dielectric layer is scaled by the layer's albedo both ways, (1 - E(o)) (1 - E(i))
// /
//   (1 - Eavg) (Kelemen and Szirmay-Kalos 2001), instead of 1 - F(v.h): reciprocal, and white stays white.
// - What lies under the clearcoat is scaled by 1 - the coat's albedo towards wo, where the extension has the
// Fresnel
//   term there: like the extension's, not reciprocal.
#include "src/render/bsdf.h"

#include <algorithm>
#include <cmath>

#include "src/render/albedo_tables.h"
#include "src/render/microfacet.h"

namespace promenade::render {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kSmoothRoughness = 0.02f;  // alpha 0.0004: a mirror to any eye, and the end of float's digits
constexpr float kCoatF0 = 0.04f;
// Below this, rough refraction bends too little for a half vector to be told from rounding.
constexpr float kSmallestRoughIor = 1.01f;

float meanOf(const Rgb& v) {
  return (v.r + v.g + v.b) * (1.0f / 3.0f);
}
float maxOf(const Rgb& v) {
  return std::max({v.r, v.g, v.b});
}

Rgb schlick(const Rgb& f0, float f90, float weight) {
  return f0 * (1.0f - weight) + Rgb(f90 * weight);
}

SpecularAlbedo specularAlbedo(float cosine, float roughness) {
  if (roughness < kSmoothRoughness) return {1.0f - schlickWeight(cosine), schlickWeight(cosine)};
  return specularAlbedoTable().directional(cosine, roughness);
}

/// Colour of light that has left the microfacets after more than one bounce (Kulla and Conty 2017, with the
/// mean of Schlick's Fresnel term).
Rgb multipleScatteringTint(const Rgb& f0, float f90, float wholeAverage) {
  const Rgb mean = f0 + (Rgb(f90) - f0) * (1.0f / 21.0f);
  return mean * mean * wholeAverage / (Rgb(1.0f) - mean * (1.0f - wholeAverage));
}

/// 1 / (pi (1 - average)): normalises the product of two "what is left" factors.
float overRest(float average) {
  return average < 0.99999f ? 1.0f / (kPi * (1.0f - average)) : 0.0f;
}

/// Schlick's Fresnel term of the glossy layer, split by what a facet does with the light.
struct FacetColors {
  Rgb reflected{0.0f};
  Rgb transmitted{0.0f};
  /// Which share of the samples on such a facet is reflected.
  [[nodiscard]] float reflectionProbability() const {
    const float r = meanOf(reflected);
    const float t = meanOf(transmitted);
    return t > 0.0f ? r / (r + t) : 1.0f;
  }
};

/// Everything about a material that does not depend on wi.
class Surface {
 public:
  Surface(const BsdfParameters& parameters, float cosOut);

  [[nodiscard]] BsdfValue evaluate(const glm::vec3& wo, const glm::vec3& wi) const;
  [[nodiscard]] BsdfSample sample(const glm::vec3& wo, float choose, glm::vec2 u) const;
  [[nodiscard]] BsdfAlbedo albedo(float cosOut) const;
  [[nodiscard]] Rgb straightTransmittance(float cosOut) const;

 private:
  [[nodiscard]] FacetColors facetColors(const glm::vec3& w, const glm::vec3& h) const;
  [[nodiscard]] BsdfValue evaluateReflection(const glm::vec3& wo, const glm::vec3& wi) const;
  [[nodiscard]] BsdfValue evaluateTransmission(const glm::vec3& wo, const glm::vec3& wi) const;
  [[nodiscard]] BsdfSample sampleSmoothBase(const glm::vec3& wo, float choose) const;
  [[nodiscard]] glm::vec3 sampleRoughBase(const glm::vec3& wo, float choose, glm::vec2 u) const;

  // The glossy base: metal and dielectric share their facets.
  float roughness_;
  bool smooth_;
  Ggx ggx_;
  Rgb f0_;  // of what reflects without refracting, weighted by how much of it there is
  float f90_;
  Rgb dielectricF0_;
  float dielectricF90_;
  Rgb base_;
  float thin_ = 0.0f;        // weight of thin-walled transmission
  float refracting_ = 0.0f;  // weight of the refracting boundary
  float relativeIor_;
  float boundaryScale_ = 1.0f;  // one over the boundary's albedo
  SpecularAlbedo out_;          // the facets' albedo towards wo
  SpecularAlbedo average_;
  Rgb againColor_;      // reflected after several bounces, without its directional factors
  Rgb thinAgainColor_;  // the same, transmitted
  float againScale_;    // (1 - E(wo)) / (pi (1 - Eavg))
  float layerF0_;       // the dielectric layer as its diffuse base sees it: the largest channel
  float layerAgain_;
  Rgb diffuseColor_;  // times (1 - layer albedo towards wi)

  // The clearcoat.
  float coat_;
  float coatRoughness_;
  bool coatSmooth_;
  Ggx coatGgx_;
  SpecularAlbedo coatOut_;
  float coatAgain_ = 0.0f;  // like againColor_ * againScale_
  float underCoat_ = 1.0f;  // what the coat leaves to the base

  // Chances of the lobes.
  float chooseCoat_;
  float chooseFacet_;
  float chooseUp_;
  float chooseDown_;

  [[nodiscard]] float layerAlbedo(const SpecularAlbedo& albedo) const {
    return std::min(albedo.of(layerF0_, dielectricF90_) + layerAgain_ * (1.0f - albedo.whole()), 1.0f);
  }
};

Surface::Surface(const BsdfParameters& p, float cosOut)
    : roughness_(std::clamp(p.roughness, 0.0f, 1.0f)),
      smooth_(roughness_ < kSmoothRoughness),
      ggx_(roughness_ * roughness_),
      base_(glm::clamp(p.baseColor, 0.0f, 1.0f)),
      coat_(p.insideMaterial ? 0.0f : std::clamp(p.clearcoat, 0.0f, 1.0f)),
      coatRoughness_(std::clamp(p.clearcoatRoughness, 0.0f, 1.0f)),
      coatSmooth_(coatRoughness_ < kSmoothRoughness),
      coatGgx_(coatRoughness_ * coatRoughness_) {
  const float metal = std::clamp(p.metallic, 0.0f, 1.0f);
  const float transmitting = (1.0f - metal) * std::clamp(p.transmission, 0.0f, 1.0f);
  const bool refracts = !p.thinWalled && p.ior > 0.0f;
  (refracts ? refracting_ : thin_) = transmitting;
  const float ior = smooth_ ? std::max(p.ior, 1.0f) : std::max(p.ior, kSmallestRoughIor);
  relativeIor_ = p.insideMaterial ? 1.0f / ior : ior;

  const float specular = std::clamp(p.specular, 0.0f, 1.0f);
  dielectricF0_ = glm::min(reflectanceOfIor(p.ior) * p.specularColor, Rgb(1.0f)) * specular;
  dielectricF90_ = specular;
  layerF0_ = maxOf(dielectricF0_);
  const float layer = 1.0f - metal - refracting_;
  f0_ = dielectricF0_ * layer + base_ * metal;
  f90_ = dielectricF90_ * layer + metal;

  out_ = specularAlbedo(cosOut, roughness_);
  average_ = specularAlbedoTable().average(smooth_ ? 0.0f : roughness_);
  const Rgb dielectricAgain = multipleScatteringTint(dielectricF0_, dielectricF90_, average_.whole());
  layerAgain_ = maxOf(dielectricAgain);
  againColor_ = dielectricAgain * layer;
  if (metal > 0.0f) againColor_ += multipleScatteringTint(base_, 1.0f, average_.whole()) * metal;
  thinAgainColor_ = base_ * (thin_ * std::max(0.0f, 1.0f - layerAgain_));
  againScale_ = smooth_ ? 0.0f : (1.0f - out_.whole()) * overRest(average_.whole());
  if (refracting_ > 0.0f && !smooth_) {
    boundaryScale_ = 1.0f / boundaryAlbedoTable().directional(cosOut, roughness_, relativeIor_);
  }
  const float diffuse = layer - thin_;
  const float layerOut = layerAlbedo(out_);
  diffuseColor_ = base_ * (diffuse * (1.0f - layerOut) * overRest(layerAlbedo(average_)));

  float coatAlbedo = 0.0f;
  if (coat_ > 0.0f) {
    coatOut_ = specularAlbedo(cosOut, coatRoughness_);
    coatAlbedo = coat_ * coatOut_.of(kCoatF0, 1.0f);
    underCoat_ = 1.0f - coatAlbedo;
    if (!coatSmooth_) {
      const float average = specularAlbedoTable().average(coatRoughness_).whole();
      const float tint = coat_ * multipleScatteringTint(Rgb(kCoatF0), 1.0f, average).r;
      coatAgain_ = tint * (1.0f - coatOut_.whole()) * overRest(average);
      underCoat_ -= tint * (1.0f - coatOut_.whole());
    }
  }

  // Each lobe is chosen by its albedo.
  const float missing = smooth_ ? 0.0f : 1.0f - out_.whole();
  const float boundaryReflects = out_.of(layerF0_, dielectricF90_);
  const float facet = meanOf(f0_) * out_.scale + f90_ * out_.bias +
                      meanOf(base_) * thin_ * std::max(0.0f, out_.whole() - boundaryReflects) +
                      refracting_ * (boundaryReflects + meanOf(base_) * (1.0f - boundaryReflects));
  chooseCoat_ = coatAlbedo;
  chooseFacet_ = underCoat_ * facet;
  chooseUp_ = underCoat_ * (meanOf(base_) * diffuse * (1.0f - layerOut) + meanOf(againColor_) * missing);
  if (coatAgain_ > 0.0f) chooseUp_ += std::max(0.0f, 1.0f - underCoat_ - coatAlbedo);
  chooseDown_ = underCoat_ * meanOf(thinAgainColor_) * missing;
  const float sum = chooseCoat_ + chooseFacet_ + chooseUp_ + chooseDown_;
  const float scale = sum > 0.0f ? 1.0f / sum : 0.0f;
  chooseCoat_ *= scale;
  chooseFacet_ *= scale;
  chooseUp_ *= scale;
  chooseDown_ *= scale;
}

FacetColors Surface::facetColors(const glm::vec3& w, const glm::vec3& h) const {
  const float cosine = std::clamp(glm::dot(w, h), 0.0f, 1.0f);
  const float weight = schlickWeight(cosine);
  FacetColors colors{schlick(f0_, f90_, weight), Rgb(0.0f)};
  if (thin_ > 0.0f) {
    colors.transmitted =
        base_ * (thin_ * std::max(0.0f, 1.0f - layerF0_ - (dielectricF90_ - layerF0_) * weight));
  }
  if (refracting_ > 0.0f) {
    const Refraction refraction = refractThrough(w, h, relativeIor_);
    const float scale = refracting_ * boundaryScale_;
    if (refraction.cosine > 0.0f) {
      const Rgb fresnel = schlick(dielectricF0_, dielectricF90_,
                                  boundarySchlickWeight(cosine, refraction.cosine, relativeIor_));
      colors.reflected += fresnel * scale;
      colors.transmitted += base_ * (scale * std::max(0.0f, 1.0f - maxOf(fresnel)));
    } else {
      colors.reflected += Rgb(scale);
    }
  }
  return colors;
}

BsdfValue Surface::evaluateReflection(const glm::vec3& wo, const glm::vec3& wi) const {
  BsdfValue value;
  const float cosIn = wi.z;
  const glm::vec3 h = glm::normalize(wo + wi);
  const SpecularAlbedo in = specularAlbedo(cosIn, roughness_);
  value.diffuse = diffuseColor_ * (underCoat_ * (1.0f - layerAlbedo(in)) * cosIn);
  value.viewDependent = againColor_ * (underCoat_ * againScale_ * (1.0f - in.whole()) * cosIn);
  value.pdf = chooseUp_ * cosIn * (1.0f / kPi);
  if (!smooth_) {
    const FacetColors colors = facetColors(wo, h);
    const float d = ggx_.distribution(h);
    value.viewDependent += colors.reflected * (underCoat_ * d * ggx_.visibility(wo.z, cosIn) * cosIn);
    value.pdf += chooseFacet_ * colors.reflectionProbability() * d * ggx_.visibility(wo.z);
  }
  if (coat_ > 0.0f && !coatSmooth_) {
    const float fresnel = coat_ * (kCoatF0 + (1.0f - kCoatF0) * schlickWeight(glm::dot(wo, h)));
    const float d = coatGgx_.distribution(h);
    const float again = coatAgain_ * (1.0f - specularAlbedo(cosIn, coatRoughness_).whole());
    value.viewDependent += Rgb((fresnel * d * coatGgx_.visibility(wo.z, cosIn) + again) * cosIn);
    value.pdf += chooseCoat_ * d * coatGgx_.visibility(wo.z);
  }
  return value;
}

BsdfValue Surface::evaluateTransmission(const glm::vec3& wo, const glm::vec3& wi) const {
  BsdfValue value;
  if (smooth_) return value;
  const float cosIn = -wi.z;
  if (thin_ > 0.0f) {
    // The reflected lobe mirrored to the far side (KHR_materials_transmission).
    const glm::vec3 h = glm::normalize(wo + glm::vec3(wi.x, wi.y, cosIn));
    const FacetColors colors = facetColors(wo, h);
    const float d = ggx_.distribution(h);
    const float again = againScale_ * (1.0f - specularAlbedo(cosIn, roughness_).whole());
    value.viewDependent = underCoat_ * cosIn *
                          (colors.transmitted * (d * ggx_.visibility(wo.z, cosIn)) + thinAgainColor_ * again);
    value.pdf = chooseFacet_ * (1.0f - colors.reflectionProbability()) * d * ggx_.visibility(wo.z) +
                chooseDown_ * cosIn * (1.0f / kPi);
    return value;
  }
  if (refracting_ > 0.0f) {
    // Walter 2007, eqs. 16, 17 and 21.
    glm::vec3 h = glm::normalize(wo + wi * relativeIor_);
    if (h.z < 0.0f) h = -h;
    const float cosHalfOut = glm::dot(wo, h);
    const float cosHalfIn = glm::dot(wi, h);
    if (cosHalfOut <= 0.0f || cosHalfIn >= 0.0f) return value;
    const FacetColors colors = facetColors(wo, h);
    const float denominator = cosHalfOut + relativeIor_ * cosHalfIn;
    const float facetDensity = 4.0f * ggx_.distribution(h) * cosHalfOut * relativeIor_ * relativeIor_ *
                               -cosHalfIn / (denominator * denominator);
    value.viewDependent =
        colors.transmitted * (underCoat_ * facetDensity * ggx_.visibility(wo.z, cosIn) * cosIn);
    value.pdf = chooseFacet_ * (1.0f - colors.reflectionProbability()) * facetDensity * ggx_.visibility(wo.z);
  }
  return value;
}

BsdfValue Surface::evaluate(const glm::vec3& wo, const glm::vec3& wi) const {
  if (wi.z > 0.0f) return evaluateReflection(wo, wi);
  if (wi.z < 0.0f) return evaluateTransmission(wo, wi);
  return {};
}

BsdfSample Surface::sampleSmoothBase(const glm::vec3& wo, float choose) const {
  const glm::vec3 normal(0.0f, 0.0f, 1.0f);
  const FacetColors colors = facetColors(wo, normal);
  const float reflects = colors.reflectionProbability();
  BsdfSample result;
  result.delta = true;
  if (choose < reflects) {
    result.wi = {-wo.x, -wo.y, wo.z};
    result.pdf = chooseFacet_ * reflects;
    result.viewDependent = colors.reflected * (underCoat_ / result.pdf);
    return result;
  }
  result.wi = thin_ > 0.0f ? -wo : refractThrough(wo, normal, relativeIor_).direction;
  result.pdf = chooseFacet_ * (1.0f - reflects);
  result.viewDependent = colors.transmitted * (underCoat_ / result.pdf);
  return result;
}

glm::vec3 Surface::sampleRoughBase(const glm::vec3& wo, float choose, glm::vec2 u) const {
  const glm::vec3 h = ggx_.sampleVisibleNormal(wo, u);
  const glm::vec3 reflected = h * (2.0f * glm::dot(wo, h)) - wo;
  if (choose < facetColors(wo, h).reflectionProbability()) {
    return reflected.z > 0.0f ? reflected : glm::vec3(0.0f);
  }
  if (thin_ > 0.0f)
    return reflected.z > 0.0f ? glm::vec3(reflected.x, reflected.y, -reflected.z) : glm::vec3(0.0f);
  const glm::vec3 refracted = refractThrough(wo, h, relativeIor_).direction;
  return refracted.z < 0.0f ? refracted : glm::vec3(0.0f);
}

glm::vec3 sampleCosine(glm::vec2 u) {
  const float radius = std::sqrt(u.x);
  const float phi = 2.0f * kPi * u.y;
  return {radius * std::cos(phi), radius * std::sin(phi), std::sqrt(std::max(0.0f, 1.0f - u.x))};
}

BsdfSample Surface::sample(const glm::vec3& wo, float choose, glm::vec2 u) const {
  BsdfSample result;
  if (choose < chooseCoat_) {
    if (coatSmooth_) {
      result.wi = {-wo.x, -wo.y, wo.z};
      result.pdf = chooseCoat_;
      result.viewDependent = Rgb(coat_ * coatOut_.of(kCoatF0, 1.0f) / chooseCoat_);
      result.delta = true;
      return result;
    }
    const glm::vec3 h = coatGgx_.sampleVisibleNormal(wo, u);
    result.wi = h * (2.0f * glm::dot(wo, h)) - wo;
    if (result.wi.z <= 0.0f) return {};
  } else if (choose < chooseCoat_ + chooseFacet_) {
    const float again = std::min((choose - chooseCoat_) / chooseFacet_, 0x1.fffffep-1f);
    if (smooth_) return sampleSmoothBase(wo, again);
    result.wi = sampleRoughBase(wo, again, u);
  } else {
    result.wi = sampleCosine(u);
    if (choose >= 1.0f - chooseDown_) result.wi.z = -result.wi.z;
  }
  const BsdfValue value = evaluate(wo, result.wi);
  if (!(value.pdf > 0.0f)) return {};
  result.pdf = value.pdf;
  result.diffuse = value.diffuse / value.pdf;
  result.viewDependent = value.viewDependent / value.pdf;
  return result;
}

BsdfAlbedo Surface::albedo(float cosOut) const {
  BsdfAlbedo result;
  const float missing = smooth_ ? 0.0f : 1.0f - out_.whole();
  const float rest = 1.0f - layerAlbedo(average_);
  result.diffuse = diffuseColor_ * (underCoat_ * kPi * rest);
  result.viewDependent = f0_ * out_.scale + Rgb(f90_ * out_.bias) + againColor_ * missing +
                         base_ * (thin_ * (1.0f - layerAlbedo(out_)));
  if (refracting_ > 0.0f) {
    const Refraction refraction = refractThrough(
        {std::sqrt(std::max(0.0f, 1.0f - cosOut * cosOut)), 0.0f, cosOut}, {0.0f, 0.0f, 1.0f}, relativeIor_);
    const Rgb fresnel = refraction.cosine > 0.0f
                            ? schlick(dielectricF0_, dielectricF90_,
                                      boundarySchlickWeight(cosOut, refraction.cosine, relativeIor_))
                            : Rgb(1.0f);
    result.viewDependent += refracting_ * (fresnel + base_ * std::max(0.0f, 1.0f - maxOf(fresnel)));
  }
  result.viewDependent = result.viewDependent * underCoat_ + Rgb(1.0f - underCoat_);
  return result;
}

Rgb Surface::straightTransmittance(float cosOut) const {
  if (!smooth_ || thin_ <= 0.0f) return Rgb(0.0f);
  const glm::vec3 wo(std::sqrt(std::max(0.0f, 1.0f - cosOut * cosOut)), 0.0f, cosOut);
  return facetColors(wo, {0.0f, 0.0f, 1.0f}).transmitted * underCoat_;
}

}  // namespace

BsdfValue evaluateBsdf(const BsdfParameters& parameters, const glm::vec3& wo, const glm::vec3& wi) {
  if (!(wo.z > 0.0f)) return {};
  return Surface(parameters, wo.z).evaluate(wo, wi);
}

BsdfSample sampleBsdf(const BsdfParameters& parameters, const glm::vec3& wo, float choose, glm::vec2 u) {
  if (!(wo.z > 0.0f)) return {};
  return Surface(parameters, wo.z).sample(wo, choose, u);
}

BsdfAlbedo bsdfAlbedo(const BsdfParameters& parameters, float cosThetaOut) {
  if (!(cosThetaOut > 0.0f)) return {};
  return Surface(parameters, cosThetaOut).albedo(cosThetaOut);
}

Rgb straightTransmittance(const BsdfParameters& parameters, float cosThetaOut) {
  if (!(cosThetaOut > 0.0f) || parameters.transmission <= 0.0f || !parameters.thinWalled) return Rgb(0.0f);
  return Surface(parameters, cosThetaOut).straightTransmittance(cosThetaOut);
}

}  // namespace promenade::render
