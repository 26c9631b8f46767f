// glTF 2.0, appendix B (metallic-roughness), with KHR_materials_ior, _specular, _clearcoat, _transmission,
// _volume. Departures, all for the sake of energy conservation:
// - Masked light is given back: a diffuse-like lobe of the missing energy for reflection and for thin walls
//   (Kulla and Conty, Revisiting Physically Based Shading at Imageworks, SIGGRAPH 2017 course), a scaling of
//   the lobes by one over their albedo for refracting boundaries (Turquin, Practical Multiple Scattering
//   Compensation, 2019), which is not reciprocal.
// - Diffuse light under the dielectric layer is scaled by the layer's albedo both ways,
//   (1 - E(o)) (1 - E(i)) / (1 - Eavg) (Kelemen and Szirmay-Kalos 2001), instead of 1 - F(v.h): reciprocal,
//   and white stays white.
// - What lies under the clearcoat is scaled by 1 - the coat's albedo towards wo, where the extension has the
//   Fresnel term there: like the extension's, not reciprocal.
#include "src/render/scattering_surface.h"
#include "src/render/maths.h"

#include <cassert>
#include <cmath>
#include <glm/common.hpp>

#include "src/core/display.h"

namespace promenade::render {
namespace {

// Below this, rough refraction bends too little for a half vector to be told from rounding.
constexpr float kSmallestRoughIor = 1.01f;

float unitRange(float v) {
  return std::clamp(v, 0.0f, 1.0f);
}
float alphaOf(float roughness) {
  return unitRange(roughness) * unitRange(roughness);
}
float maxOf(const Rgb& v) {
  return std::max({v.r, v.g, v.b});
}

Rgb schlick(const Rgb& f0, float f90, float weight) {
  return f0 * (1.0f - weight) + Rgb(f90 * weight);
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

}  // namespace

ScatteringSurface::ScatteringSurface(const BsdfParameters& p, const glm::vec3& wo)
    : wo_(wo),
      facets_(specularAlbedoTable().at(unitRange(p.roughness))),
      smooth_(p.roughness < kSmoothRoughness),
      ggx_(alphaOf(p.roughness)),
      base_(glm::clamp(p.baseColor, 0.0f, 1.0f)),
      out_(facets_.directional(wo.z)),
      coatBasis_(p.clearcoatNormal),
      coatWo_(coatBasis_.toLocal(wo)),
      coat_(p.insideMaterial || !(coatWo_.z > 0.0f) ? 0.0f : unitRange(p.clearcoat)),
      coatSmooth_(p.clearcoatRoughness < kSmoothRoughness),
      coatGgx_(alphaOf(p.clearcoatRoughness)) {
  const float metal = unitRange(p.metallic);
  const float transmitting = (1.0f - metal) * unitRange(p.transmission);
  const bool refracts = !p.thinWalled && p.ior > 0.0f;
  (refracts ? refracting_ : thin_) = transmitting;
  const float ior = smooth_ ? std::max(p.ior, 1.0f) : std::max(p.ior, kSmallestRoughIor);
  relativeIor_ = p.insideMaterial ? 1.0f / ior : ior;

  const float specular = unitRange(p.specular);
  dielectricF0_ = glm::min(reflectanceOfIor(p.ior) * p.specularColor, Rgb(1.0f)) * specular;
  dielectricF90_ = specular;
  layerF0_ = maxOf(dielectricF0_);
  const float layer = 1.0f - metal - refracting_;
  f0_ = dielectricF0_ * layer + base_ * metal;
  f90_ = dielectricF90_ * layer + metal;

  const SpecularAlbedo& average = facets_.average();
  const Rgb dielectricAgain = multipleScatteringTint(dielectricF0_, dielectricF90_, average.whole());
  layerAgain_ = maxOf(dielectricAgain);
  againColor_ = dielectricAgain * layer;
  if (metal > 0.0f) againColor_ += multipleScatteringTint(base_, 1.0f, average.whole()) * metal;
  thinAgainColor_ = base_ * (thin_ * std::max(0.0f, 1.0f - layerAgain_));
  againScale_ = smooth_ ? 0.0f : (1.0f - out_.whole()) * overRest(average.whole());
  if (refracting_ > 0.0f && !smooth_) {
    boundaryScale_ = 1.0f / boundaryAlbedoTable().directional(wo.z, p.roughness, relativeIor_);
  }
  const float diffuse = layer - thin_;
  const float layerOut = layerAlbedo(out_);
  diffuseColor_ = base_ * (diffuse * (1.0f - layerOut) * overRest(layerAlbedo(average)));

  float coatAlbedo = 0.0f;
  if (coat_ > 0.0f) {
    coatFacets_ = specularAlbedoTable().at(unitRange(p.clearcoatRoughness));
    coatOut_ = coatFacets_.directional(coatWo_.z);
    coatAlbedo = coat_ * coatOut_.of(kCoatF0, 1.0f);
    underCoat_ = 1.0f - coatAlbedo;
    if (!coatSmooth_) {
      const float coatAverage = coatFacets_.average().whole();
      const float tint = coat_ * multipleScatteringTint(Rgb(kCoatF0), 1.0f, coatAverage).r;
      coatAgain_ = tint * (1.0f - coatOut_.whole()) * overRest(coatAverage);
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
  normaliseChances();
}

void ScatteringSurface::normaliseChances() {
  const float sum = chooseCoat_ + chooseFacet_ + chooseUp_ + chooseDown_;
  const float scale = sum > 0.0f ? 1.0f / sum : 0.0f;
  chooseCoat_ *= scale;
  chooseFacet_ *= scale;
  chooseUp_ *= scale;
  chooseDown_ *= scale;
}

ScatteringSurface::FacetColors ScatteringSurface::facetColors(const glm::vec3& h) const {
  const float cosine = std::clamp(glm::dot(wo_, h), 0.0f, 1.0f);
  const float weight = schlickWeight(cosine);
  FacetColors colors{schlick(f0_, f90_, weight), Rgb(0.0f)};
  if (thin_ > 0.0f) {
    colors.transmitted =
        base_ * (thin_ * std::max(0.0f, 1.0f - layerF0_ - (dielectricF90_ - layerF0_) * weight));
  }
  if (refracting_ > 0.0f) {
    const Refraction refraction = refractThrough(wo_, h, relativeIor_);
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

BsdfAlbedo ScatteringSurface::albedo() const {
  BsdfAlbedo result;
  const float rest = 1.0f - layerAlbedo(facets_.average());
  result.diffuse = diffuseColor_ * (underCoat_ * kPi * rest);
  if (hasDeltaLobes_ || !smooth_) {
    const float missing = smooth_ ? 0.0f : 1.0f - out_.whole();
    Rgb base = f0_ * out_.scale + Rgb(f90_ * out_.bias) + againColor_ * missing +
               base_ * (thin_ * (1.0f - layerAlbedo(out_)));
    if (refracting_ > 0.0f) {
      const Refraction refraction = refractThrough(wo_, kLocalNormal, relativeIor_);
      const Rgb fresnel = refraction.cosine > 0.0f
                              ? schlick(dielectricF0_, dielectricF90_,
                                        boundarySchlickWeight(wo_.z, refraction.cosine, relativeIor_))
                              : Rgb(1.0f);
      base += refracting_ * (fresnel + base_ * std::max(0.0f, 1.0f - maxOf(fresnel)));
    }
    result.viewDependent = base * underCoat_;
  }
  if (hasDeltaLobes_ || !coatSmooth_) result.viewDependent += Rgb(1.0f - underCoat_);
  return result;
}

ReflectionLobe ScatteringSurface::reflectionLobe() const {
  assert(!smooth_ && !(coat_ > 0.0f) && !(thin_ + refracting_ > 0.0f));
  ReflectionLobe lobe;
  lobe.wo = wo_;
  lobe.alpha = ggx_.alpha();
  lobe.f0 = luminance(f0_);
  lobe.f90 = f90_;
  lobe.again = luminance(againColor_) * againScale_;
  lobe.masking = facets_.masking();
  return lobe;
}

DeltaLobes ScatteringSurface::deltaLobes() const {
  DeltaLobes lobes;
  if (!hasDeltaLobes_) return lobes;
  auto& [through, base, coat] = lobes;
  if (smooth_) {
    const FacetColors colors = facetColors(kLocalNormal);
    through = {thin_ > 0.0f ? -wo_ : refractThrough(wo_, kLocalNormal, relativeIor_).direction,
               underCoat_ * colors.transmitted};
    base = {{-wo_.x, -wo_.y, wo_.z}, underCoat_ * colors.reflected};
  }
  if (coat_ > 0.0f && coatSmooth_) {
    const glm::vec3 wi = coatBasis_.toWorld({-coatWo_.x, -coatWo_.y, coatWo_.z});
    const Rgb weight(coat_ * coatOut_.of(kCoatF0, 1.0f));
    if (wi == base.wi) {
      base.weight += weight;
    } else if (wi.z > 0.0f) {
      coat = {wi, weight};
    }
  }
  return lobes;
}

ScatteringSurface ScatteringSurface::withoutDeltaLobes() const {
  ScatteringSurface rest = *this;
  rest.hasDeltaLobes_ = false;
  if (coatSmooth_) rest.chooseCoat_ = 0.0f;
  if (smooth_) rest.chooseFacet_ = 0.0f;
  rest.normaliseChances();
  return rest;
}

Rgb ScatteringSurface::straightTransmittance() const {
  if (!smooth_ || thin_ <= 0.0f) return Rgb(0.0f);
  return facetColors(kLocalNormal).transmitted * underCoat_;
}

}  // namespace promenade::render
