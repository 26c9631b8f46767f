#pragma once
// The lights of a scene other than its environment: emissive triangles and punctual lights.
// Not part of the folder's public face.

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "src/render/surfaces.h"

namespace promenade::render {

struct LightSample {
  glm::vec3 direction{0.0f};  ///< unit, from the surface to the light
  glm::vec3 target{0.0f};     ///< where the shadow ray ends (just off the light's surface)
  bool atInfinity = false;    ///< there is no target: the shadow ray goes on for ever
  Rgb radiance{0.0f};         ///< for a delta light: irradiance on a surface that faces it
  float pdf = 0.0f;           ///< solid angle, times the probability of the light; a delta light: that alone
  bool delta = false;         ///< cannot be found by chance
};

class Lights {
 public:
  /// `sceneRadius`: of a sphere around the scene, for the power of directional lights. `surfaces` must
  /// outlive this.
  Lights(const Surfaces& surfaces, float sceneRadius);

  [[nodiscard]] bool empty() const { return lights_.empty(); }

  /// One light point seen from `position`; nothing if it does not shine this way.
  [[nodiscard]] std::optional<LightSample> sample(const glm::vec3& position, float choose, glm::vec2 u) const;

  /// The density with which sample() finds the point of the emissive triangle that a ray of unit `direction`
  /// hit at `distance`; 0 if the triangle is not among the lights.
  [[nodiscard]] float pdf(std::uint32_t instance, std::uint32_t triangle, const glm::vec3& direction,
                          float distance) const;

 private:
  struct Light {
    std::uint32_t instance = 0;  // of an emissive triangle, else kPunctual
    std::uint32_t index = 0;     // its triangle, or the index into Scene::lights
    float probability = 0.0f;
  };
  static constexpr std::uint32_t kPunctual = 0xffffffffu;

  [[nodiscard]] std::optional<LightSample> sampleTriangle(const Light& light, const glm::vec3& position,
                                                          glm::vec2 u) const;
  [[nodiscard]] std::optional<LightSample> samplePunctual(const PunctualLight& light, float probability,
                                                          const glm::vec3& position) const;

  const Surfaces& surfaces_;
  std::vector<Light> lights_;
  std::vector<float> cumulative_;
  std::vector<std::int64_t> firstOfInstance_;  // index into lightOfTriangle_, -1: the instance does not shine
  std::vector<std::int32_t> lightOfTriangle_;  // index into lights_, -1: not sampled
};

}  // namespace promenade::render
