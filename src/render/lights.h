#pragma once
// The lights of a scene other than its environment: emissive triangles and punctual lights.
// Not part of the folder's public face.

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "src/render/light_tree.h"
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
  /// `surfaces` must outlive this.
  explicit Lights(const Surfaces& surfaces);

  [[nodiscard]] bool empty() const { return lights_.empty() && directional_.empty(); }

  /// One light point for the surface at `position` with unit `normal` (either side); nothing if it does not
  /// shine there.
  [[nodiscard]] std::optional<LightSample> sample(const glm::vec3& position, const glm::vec3& normal,
                                                  float choose, glm::vec2 u) const;
  /// The same for whoever asks often at one place.
  [[nodiscard]] LightTree::View viewFrom(const glm::vec3& position, const glm::vec3& normal) const {
    return {tree_, position, normal};
  }
  [[nodiscard]] std::optional<LightSample> sample(LightTree::View& view, float choose, glm::vec2 u) const;

  /// Every point, spot and directional light that shines at `position`, each with density 1.
  template <class Visit>
  void forEachDelta(const glm::vec3& position, const Visit& visit) const {
    for (const PunctualLight& light : surfaces_.scene().lights) {
      if (const auto sample = samplePunctual(light, 1.0f, position)) visit(*sample);
    }
  }

  /// Where a ray from the surface at `position` found an emissive triangle.
  struct Found {
    std::uint32_t instance = 0;
    std::uint32_t triangle = 0;
    glm::vec3 direction{0.0f};  ///< unit, of the ray
    float distance = 0.0f;      ///< from `position`
  };
  /// The density with which sample() would have chosen that point; 0 if the triangle is not among the lights.
  [[nodiscard]] float pdf(const Found& found, const glm::vec3& position, const glm::vec3& normal) const;

 private:
  struct Light {
    std::uint32_t instance = 0;  // of an emissive triangle, else kPunctual
    std::uint32_t index = 0;     // its triangle, or the index into Scene::lights
  };
  static constexpr std::uint32_t kPunctual = 0xffffffffu;

  /// chooseFrom(u) as LightTree::choose().
  template <class ChooseFrom>
  [[nodiscard]] std::optional<LightSample> sampleAt(const glm::vec3& position, float choose, glm::vec2 u,
                                                    const ChooseFrom& chooseFrom) const;
  [[nodiscard]] std::optional<LightSample> sampleTriangle(const Light& light, float probability,
                                                          const glm::vec3& position, glm::vec2 u) const;
  [[nodiscard]] std::optional<LightSample> samplePunctual(const PunctualLight& light, float probability,
                                                          const glm::vec3& position) const;

  const Surfaces& surfaces_;
  std::vector<Light> lights_;               // at finite distance, in the order of the tree's lights
  std::vector<std::uint32_t> directional_;  // indices into Scene::lights
  float directionalShare_ = 0.0f;           // probability that one of those is chosen
  LightTree tree_;
  std::vector<std::int64_t> firstOfInstance_;  // index into lightOfTriangle_, -1: the instance does not shine
  std::vector<std::int32_t> lightOfTriangle_;  // index into lights_, -1: not sampled
};

}  // namespace promenade::render
