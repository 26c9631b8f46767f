// Values, densities and samples of the lobes that scattering_surface.cpp has weighed (the departures from
// glTF are listed there).
#include "src/render/bsdf.h"

#include <algorithm>
#include <cmath>

#include "src/render/basis.h"
#include "src/render/maths.h"
#include "src/render/scattering_surface.h"

namespace promenade::render {

BsdfValue ScatteringSurface::evaluateReflection(const glm::vec3& wi) const {
  BsdfValue value;
  const float cosIn = wi.z;
  const SpecularAlbedo in = facets_.directional(cosIn);
  value.diffuse = diffuseColor_ * (underCoat_ * (1.0f - layerAlbedo(in)) * cosIn);
  value.viewDependent = againColor_ * (underCoat_ * againScale_ * (1.0f - in.whole()) * cosIn);
  value.pdf = chooseUp_ * cosIn * (1.0f / kPi);
  if (!smooth_) {
    const glm::vec3 h = glm::normalize(wo_ + wi);
    const FacetColors colors = facetColors(h);
    const float d = ggx_.distribution(h);
    value.viewDependent += colors.reflected * (underCoat_ * d * ggx_.visibility(wo_.z, cosIn) * cosIn);
    value.pdf += chooseFacet_ * colors.reflectionProbability() * d * ggx_.visibility(wo_.z);
  }
  if (coat_ > 0.0f && !coatSmooth_) {
    const BsdfValue coat = evaluateRoughCoat(wi);
    value.viewDependent += coat.viewDependent;
    value.pdf += coat.pdf;
  }
  return value;
}

BsdfValue ScatteringSurface::evaluateRoughCoat(const glm::vec3& wi) const {
  BsdfValue value;
  const glm::vec3 in = coatBasis_.toLocal(wi);
  if (!(in.z > 0.0f)) return value;
  const glm::vec3 h = glm::normalize(coatWo_ + in);
  const float fresnel = coat_ * (kCoatF0 + (1.0f - kCoatF0) * schlickWeight(glm::dot(coatWo_, h)));
  const float d = coatGgx_.distribution(h);
  const float again = coatAgain_ * (1.0f - coatFacets_.directional(in.z).whole());
  value.viewDependent = Rgb((fresnel * d * coatGgx_.visibility(coatWo_.z, in.z) + again) * in.z);
  value.pdf = chooseCoat_ * d * coatGgx_.visibility(coatWo_.z);
  return value;
}

BsdfValue ScatteringSurface::evaluateTransmission(const glm::vec3& wi) const {
  BsdfValue value;
  if (smooth_) return value;
  const float cosIn = -wi.z;
  if (thin_ > 0.0f) {
    // The reflected lobe mirrored to the far side (KHR_materials_transmission).
    const glm::vec3 h = glm::normalize(wo_ + glm::vec3(wi.x, wi.y, cosIn));
    const FacetColors colors = facetColors(h);
    const float d = ggx_.distribution(h);
    const float again = againScale_ * (1.0f - facets_.directional(cosIn).whole());
    value.viewDependent =
        underCoat_ * cosIn *
        (colors.transmitted * (d * ggx_.visibility(wo_.z, cosIn)) + thinAgainColor_ * again);
    value.pdf = chooseFacet_ * (1.0f - colors.reflectionProbability()) * d * ggx_.visibility(wo_.z) +
                chooseDown_ * cosIn * (1.0f / kPi);
    return value;
  }
  if (refracting_ > 0.0f) {
    // Walter 2007, eqs. 16, 17 and 21.
    glm::vec3 h = glm::normalize(wo_ + wi * relativeIor_);
    if (h.z < 0.0f) h = -h;
    const float cosHalfOut = glm::dot(wo_, h);
    const float cosHalfIn = glm::dot(wi, h);
    if (cosHalfOut <= 0.0f || cosHalfIn >= 0.0f) return value;
    const FacetColors colors = facetColors(h);
    const float denominator = cosHalfOut + relativeIor_ * cosHalfIn;
    const float facetDensity = 4.0f * ggx_.distribution(h) * cosHalfOut * relativeIor_ * relativeIor_ *
                               -cosHalfIn / (denominator * denominator);
    value.viewDependent =
        colors.transmitted * (underCoat_ * facetDensity * ggx_.visibility(wo_.z, cosIn) * cosIn);
    value.pdf =
        chooseFacet_ * (1.0f - colors.reflectionProbability()) * facetDensity * ggx_.visibility(wo_.z);
  }
  return value;
}

BsdfValue ScatteringSurface::evaluate(const glm::vec3& wi) const {
  if (wi.z > 0.0f) return evaluateReflection(wi);
  if (wi.z < 0.0f) return evaluateTransmission(wi);
  return {};
}

BsdfSample ScatteringSurface::sampleSmoothBase(float choose) const {
  const FacetColors colors = facetColors(kLocalNormal);
  const float reflects = colors.reflectionProbability();
  BsdfSample result;
  result.delta = true;
  if (choose < reflects) {
    result.wi = {-wo_.x, -wo_.y, wo_.z};
    result.pdf = chooseFacet_ * reflects;
    result.viewDependent = colors.reflected * (underCoat_ / result.pdf);
    return result;
  }
  result.wi = thin_ > 0.0f ? -wo_ : refractThrough(wo_, kLocalNormal, relativeIor_).direction;
  result.pdf = chooseFacet_ * (1.0f - reflects);
  result.viewDependent = colors.transmitted * (underCoat_ / result.pdf);
  return result;
}

glm::vec3 ScatteringSurface::sampleRoughBase(float choose, glm::vec2 u) const {
  const glm::vec3 h = ggx_.sampleVisibleNormal(wo_, u);
  const glm::vec3 reflected = h * (2.0f * glm::dot(wo_, h)) - wo_;
  if (choose < facetColors(h).reflectionProbability()) {
    return reflected.z > 0.0f ? reflected : glm::vec3(0.0f);
  }
  if (thin_ > 0.0f)
    return reflected.z > 0.0f ? glm::vec3(reflected.x, reflected.y, -reflected.z) : glm::vec3(0.0f);
  const glm::vec3 refracted = refractThrough(wo_, h, relativeIor_).direction;
  return refracted.z < 0.0f ? refracted : glm::vec3(0.0f);
}

BsdfSample ScatteringSurface::sample(float choose, glm::vec2 u) const {
  BsdfSample result;
  if (choose < chooseCoat_) {
    if (coatSmooth_) {
      result.wi = coatBasis_.toWorld({-coatWo_.x, -coatWo_.y, coatWo_.z});
      if (result.wi.z <= 0.0f) return {};
      result.pdf = chooseCoat_;
      result.viewDependent = Rgb(coat_ * coatOut_.of(kCoatF0, 1.0f) / chooseCoat_);
      result.delta = true;
      return result;
    }
    const glm::vec3 h = coatGgx_.sampleVisibleNormal(coatWo_, u);
    const glm::vec3 in = h * (2.0f * glm::dot(coatWo_, h)) - coatWo_;
    if (in.z <= 0.0f) return {};
    result.wi = coatBasis_.toWorld(in);
    if (result.wi.z <= 0.0f) return {};
  } else if (choose < chooseCoat_ + chooseFacet_) {
    const float again = std::min((choose - chooseCoat_) / chooseFacet_, 0x1.fffffep-1f);
    if (smooth_) return sampleSmoothBase(again);
    result.wi = sampleRoughBase(again, u);
  } else {
    result.wi = sampleCosine(u);
    if (choose >= 1.0f - chooseDown_) result.wi.z = -result.wi.z;
  }
  const BsdfValue value = evaluate(result.wi);
  if (!(value.pdf > 0.0f)) return {};
  result.pdf = value.pdf;
  result.diffuse = value.diffuse / value.pdf;
  result.viewDependent = value.viewDependent / value.pdf;
  return result;
}

BsdfValue evaluateBsdf(const BsdfParameters& parameters, const glm::vec3& wo, const glm::vec3& wi) {
  if (!(wo.z > 0.0f)) return {};
  return ScatteringSurface(parameters, wo).evaluate(wi);
}

BsdfSample sampleBsdf(const BsdfParameters& parameters, const glm::vec3& wo, float choose, glm::vec2 u) {
  if (!(wo.z > 0.0f)) return {};
  return ScatteringSurface(parameters, wo).sample(choose, u);
}

BsdfAlbedo bsdfAlbedo(const BsdfParameters& parameters, float cosThetaOut) {
  if (!(cosThetaOut > 0.0f)) return {};
  return ScatteringSurface(parameters, directionAt(cosThetaOut)).albedo();
}

Rgb straightTransmittance(const BsdfParameters& parameters, float cosThetaOut) {
  if (!(cosThetaOut > 0.0f) || parameters.transmission <= 0.0f || !parameters.thinWalled) return Rgb(0.0f);
  return ScatteringSurface(parameters, directionAt(cosThetaOut)).straightTransmittance();
}

}  // namespace promenade::render
