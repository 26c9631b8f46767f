#pragma once
// Light from infinity: lookup and importance sampling of an Environment (the convention is in
// src/scene/scene.h). The radiance between texels is bilinear (around in u, clamped at the poles), and
// directions are chosen from the same bilinear interpolation of luminance * sin(theta) at the texels, so that
// radiance / density is nearly constant and no direction that shines has density 0. Pharr, Jakob, Humphreys,
// PBRT 4th ed., 12.5 and A.5 (there piecewise constant).

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "src/scene/scene.h"

namespace promenade::render {

struct EnvironmentSample {
  glm::vec3 direction{0.0f, 1.0f, 0.0f};  ///< world space, unit, from the surface to the light
  Rgb radiance{0.0f};
  float pdf = 0.0f;  ///< solid angle; 0: there is no light to sample
};

/// Immutable; keeps its own copy of the radiance (20 bytes a texel in all). Not-a-number and negative values
/// of the image count as 0, infinite ones as 65504 (the largest half float).
class EnvironmentLight {
 public:
  /// Precondition: the image is at least 1x1.
  explicit EnvironmentLight(const Environment& environment);

  /// `direction`: unit, world space.
  [[nodiscard]] Rgb radiance(const glm::vec3& direction) const;
  [[nodiscard]] EnvironmentSample sample(glm::vec2 u) const;
  /// As if sample() had chosen `direction`, a unit vector: with its density per solid angle; the radiance is
  /// there where the density is 0, too.
  [[nodiscard]] EnvironmentSample toward(const glm::vec3& direction) const;
  /// Average radiance over the sphere of directions: for choosing between lights.
  [[nodiscard]] Rgb meanRadiance() const { return meanRadiance_; }

 private:
  [[nodiscard]] glm::vec2 imagePosition(const glm::vec3& direction) const;
  [[nodiscard]] float densityAt(glm::vec2 uv) const;
  [[nodiscard]] float uniformPdf() const;

  Image<Rgb> radiance_;
  float rotationTurns_ = 0.0f;
  Rgb meanRadiance_{0.0f};
  bool uniform_ = false;
  Image<float> density_;  ///< per unit square of (u, v), at texel centres; empty if uniform or black
  std::vector<float> rowCumulative_;  ///< height entries, the last is 1
  Image<float> columnCumulative_;     ///< per row, the last is 1
};

}  // namespace promenade::render
