#pragma once
// Scattering at a surface point: glTF metallic-roughness with its extensions, in the local shading frame
// (z = shading normal on the side of the outgoing direction wo, so wo.z > 0). Energy conserving at every
// roughness. The diffuse and the view-dependent part are kept apart all along, as Frame wants them.
// ("Diffuse" still fades towards grazing angles, where the specular layer above it takes the light.)
//
// Radiance inside a volume is carried as basic radiance, L / n^2 (Nicodemus 1963): refraction then needs no
// factor n^2 either way, a white material neither gains nor loses, and a path may end inside without a bias
// in weight.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "src/core/image.h"

namespace promenade::render {

/// Material parameters at one point, textures applied.
struct BsdfParameters {
  Rgb baseColor{1.0f};
  float metallic = 0.0f;
  float roughness =
      1.0f;          ///< perceptual; microfacet alpha = roughness^2; below a small limit the lobe is a delta
  float ior = 1.5f;  ///< of the material, against vacuum
  float specular = 1.0f;
  Rgb specularColor{1.0f};
  float transmission = 0.0f;
  bool thinWalled = true;       ///< transmission goes straight through, without refraction
  bool insideMaterial = false;  ///< wo arrives from within the volume (thinWalled == false only)
  float clearcoat = 0.0f;
  float clearcoatRoughness = 0.0f;
  glm::vec3 clearcoatNormal{0.0f, 0.0f,
                            1.0f};  ///< unit; a normal map may belong to the base or the coat alone
};

/// Value of the scattering function times |cos(theta_i)|, and the probability density (solid angle) with
/// which sampleBsdf would have chosen wi. Delta lobes contribute nothing here.
struct BsdfValue {
  Rgb diffuse{0.0f};
  Rgb viewDependent{0.0f};
  float pdf = 0.0f;
};

struct BsdfSample {
  glm::vec3 wi{0.0f};
  Rgb diffuse{0.0f};        ///< f cos / pdf, diffuse part (pdf of all lobes together)
  Rgb viewDependent{0.0f};  ///< f cos / pdf, the rest; wi.z < 0: transmitted
  float pdf = 0.0f;         ///< 0: no light can be scattered, the path ends. Delta: meaningless but > 0
  bool delta = false;  ///< the direction was chosen from a delta lobe: next event estimation cannot find it
};

[[nodiscard]] BsdfValue evaluateBsdf(const BsdfParameters& parameters, const glm::vec3& wo,
                                     const glm::vec3& wi);

/// `choose` in [0,1) picks the lobe, `u` the direction.
[[nodiscard]] BsdfSample sampleBsdf(const BsdfParameters& parameters, const glm::vec3& wo, float choose,
                                    glm::vec2 u);

/// The share of light from a uniform white sky that goes back to wo by each part (transmitted light
/// included), for interpolated irradiance and for choosing how to trace on. `cosThetaOut` in (0, 1].
struct BsdfAlbedo {
  Rgb diffuse{0.0f};
  Rgb viewDependent{0.0f};
};
[[nodiscard]] BsdfAlbedo bsdfAlbedo(const BsdfParameters& parameters, float cosThetaOut);

/// Straight-through transmittance for shadow rays: nonzero only where the material is thin-walled and its
/// transmission lobe is a delta, so that light through a window pane need not be found by chance.
[[nodiscard]] Rgb straightTransmittance(const BsdfParameters& parameters, float cosThetaOut);

}  // namespace promenade::render
