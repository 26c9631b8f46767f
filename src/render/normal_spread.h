#pragma once
// How far the normals turn within what a sample stands for, and what that makes of its reflections: a curved
// metal reflects the mean of all the directions that its piece under the sample mirrors, not the one
// direction at its middle. Not part of the folder's public face.
//   Kaplanyan, Hill, Patney, Lefohn, Filtering Distributions of Normals for Shading Antialiasing (HPG 2016)
//   Tokuyoshi, Kaplanyan, Improved Geometric Specular Antialiasing (I3D 2019)

#include <glm/vec3.hpp>

namespace promenade::render {

struct BsdfParameters;
struct FootprintAlongEdges;

/// Of an interpolated normal along the two edges of its triangle, in units of its length.
struct NormalChange {
  glm::vec3 edge1{0.0f}, edge2{0.0f};
};

/// Variance of the unit normals over a footprint around where it is `normal`, both directions together: of a
/// parallelogram over which the normal turns evenly by a along one side and b along the other,
/// (a^2 + b^2) / 12. Going by the triangle alone, whose normals are interpolated. 0 for a footprint of no
/// extent.
[[nodiscard]] float normalVariance(const glm::vec3& normal, const NormalChange& change,
                                   const FootprintAlongEdges& footprint);

/// Perceptual roughness of the lobe that facets of `roughness` make whose mean normals vary: alpha^2 of GGX
/// stands for twice the variance of slopes along one axis (Tokuyoshi and Kaplanyan 2019), so variances add
/// up. At most 0.18 is added, as there: larger ones are of silhouettes, whose far side is not seen.
[[nodiscard]] float broadenedRoughness(float roughness, float variance);

/// The lobes of what is opaque, by the variance of its normals and of its clearcoat's. (What shines through
/// has lobes that turn by other angles.)
void broaden(BsdfParameters& bsdf, float variance, float clearcoatVariance);

}  // namespace promenade::render
