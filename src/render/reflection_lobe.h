#pragma once
// What a rough opaque surface without clearcoat reflects towards one direction, as weights of the directions
// that a light field knows. Only relative weights and their brightness matter to whoever knows the albedo, so
// this is all of ScatteringSurface::evaluate() that such a look-up needs, in a form that takes many
// directions at once. Not part of the folder's public face.

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "src/render/albedo_tables.h"
#include "src/render/basis.h"
#include "src/render/light_field.h"

namespace promenade::render {

struct ReflectionLobe {
  glm::vec3 wo{0.0f};  ///< unit, local to the shading frame, wo.z > 0
  float alpha = 1.0f;  ///< of the facets, > 0
  // Luminances of Schlick's Fresnel term at 0 and 90 degrees, and of the light that leaves after several
  // bounces between facets, without its factor of the arriving direction.
  float f0 = 0.0f, f90 = 0.0f, again = 0.0f;
  SpecularAlbedoTable::Masking masking{};  ///< E(mu) of the facets
};

/// Luminance of f cos towards the lobe's wo, times solid angle, for each cell of a field in the frame `field`
/// (world space); 0 below the horizon of `shading` (world space).
[[nodiscard]] LightField::Weights weigh(const ReflectionLobe& lobe, const Basis& shading, const Basis& field);

}  // namespace promenade::render
