#pragma once
// A material seen from one direction: all that can be worked out before it is known where the light comes
// from. An integrator that evaluates several directions at one point makes one of these; bsdf.h has the same
// as functions.

#include <algorithm>
#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "src/render/albedo_tables.h"
#include "src/render/basis.h"
#include "src/render/bsdf.h"
#include "src/render/microfacet.h"
#include "src/render/reflection_lobe.h"

namespace promenade::render {

inline constexpr float kCoatF0 = 0.04f;                     ///< a clearcoat's index of refraction is 1.5
inline constexpr glm::vec3 kLocalNormal(0.0f, 0.0f, 1.0f);  ///< of the shading frame

/// The only direction from which a smooth part of a surface sends light to wo.
struct DeltaLobe {
  glm::vec3 wi{0.0f};  ///< unit, local; z < 0: behind the surface, straight on where the wall is thin
  Rgb weight{0.0f};    ///< share of the radiance that arrives along wi; black: there is no such part
};
/// Transmitted; reflected by the base; by the clearcoat. What comes from the same direction is one lobe.
using DeltaLobes = std::array<DeltaLobe, 3>;

class ScatteringSurface {
 public:
  /// `wo`: unit, wo.z > 0, where the light goes.
  ScatteringSurface(const BsdfParameters& parameters, const glm::vec3& wo);

  [[nodiscard]] BsdfValue evaluate(const glm::vec3& wi) const;
  [[nodiscard]] BsdfSample sample(float choose, glm::vec2 u) const;
  [[nodiscard]] BsdfAlbedo albedo() const;
  [[nodiscard]] Rgb straightTransmittance() const;
  /// The view-dependent part of an opaque surface without clearcoat and delta lobes.
  [[nodiscard]] ReflectionLobe reflectionLobe() const;

  [[nodiscard]] DeltaLobes deltaLobes() const;
  /// The same surface for whoever follows deltaLobes() by themselves: values, samples and albedo of the rest.
  [[nodiscard]] ScatteringSurface withoutDeltaLobes() const;

 private:
  /// Schlick's Fresnel term of the glossy layer, split by what a facet does with the light.
  struct FacetColors {
    Rgb reflected{0.0f};
    Rgb transmitted{0.0f};
    /// Which share of the samples on such a facet is reflected.
    [[nodiscard]] float reflectionProbability() const {
      const float r = reflected.r + reflected.g + reflected.b;
      const float t = transmitted.r + transmitted.g + transmitted.b;
      return t > 0.0f ? r / (r + t) : 1.0f;
    }
  };
  [[nodiscard]] FacetColors facetColors(const glm::vec3& h) const;
  void normaliseChances();
  [[nodiscard]] BsdfValue evaluateReflection(const glm::vec3& wi) const;
  [[nodiscard]] BsdfValue evaluateRoughCoat(const glm::vec3& wi) const;
  [[nodiscard]] BsdfValue evaluateTransmission(const glm::vec3& wi) const;
  [[nodiscard]] BsdfSample sampleSmoothBase(float choose) const;
  [[nodiscard]] glm::vec3 sampleRoughBase(float choose, glm::vec2 u) const;

  glm::vec3 wo_;

  // The glossy base: metal and dielectric share their facets.
  SpecularAlbedoTable::Row facets_;
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
  Rgb againColor_;              // reflected after several bounces, without its directional factors
  Rgb thinAgainColor_;          // the same, transmitted
  float againScale_;            // (1 - E(wo)) / (pi (1 - Eavg))
  float layerF0_;               // the dielectric layer as its diffuse base sees it: the largest channel
  float layerAgain_;
  Rgb diffuseColor_;  // times (1 - layer albedo towards wi)

  // The clearcoat, which has a frame of its own.
  Basis coatBasis_;
  glm::vec3 coatWo_;
  float coat_;  // 0 where wo is under its horizon
  SpecularAlbedoTable::Row coatFacets_;
  bool coatSmooth_;
  Ggx coatGgx_;
  SpecularAlbedo coatOut_;
  float coatAgain_ = 0.0f;  // like againColor_ * againScale_
  float underCoat_ = 1.0f;  // what the coat leaves to the base

  bool hasDeltaLobes_ = true;

  // Chances of the lobes.
  float chooseCoat_;
  float chooseFacet_;
  float chooseUp_;
  float chooseDown_;

  [[nodiscard]] float layerAlbedo(const SpecularAlbedo& albedo) const {
    return std::min(albedo.of(layerF0_, dielectricF90_) + layerAgain_ * (1.0f - albedo.whole()), 1.0f);
  }
};

}  // namespace promenade::render
