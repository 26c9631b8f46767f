#pragma once
// Progressive radiosity over the triangles of a diffuse scene: a solution of the same equation by other
// means, for comparison with path tracing. Shooting: Cohen, Chen, Wallace, Greenberg, A progressive
// refinement approach to fast radiosity image generation (SIGGRAPH 1988). Form factors: the share of
// cosine-distributed rays from a patch that end on another.

#include <vector>

#include "src/render/embree_scene.h"
#include "src/render/surfaces.h"
#include "src/scene/scene.h"

namespace promenade::tests {

/// A triangle that is one value. Reflects and shines on its front.
struct Patch {
  glm::vec3 a{0.0f}, b{0.0f}, c{0.0f};
  glm::vec3 normal{0.0f};  ///< unit, front
  float area = 0.0f;
  Rgb reflectance{0.0f};
  Rgb radiance{0.0f};  ///< that it sends to everywhere: radiosity / pi
  Rgb unshot{0.0f};    ///< the part of it that the others have not had

  [[nodiscard]] glm::vec3 centre() const { return (a + b + c) / 3.0f; }
};

/// The scene with every triangle cut until no edge is longer (world space, one instance a mesh, matt: base
/// colours and emission factors alone).
[[nodiscard]] Scene mattMesh(const Scene& scene, float longestEdge);

class Radiosity {
 public:
  /// Of a scene from mattMesh(); both must outlive this.
  Radiosity(const render::Surfaces& surfaces, const render::EmbreeScene& embree);

  /// Shoots from the patch with the most unshot power, again and again, until all that is unshot is this
  /// share of what was emitted.
  void shoot(double unshotShare, int raysPerShot);

  /// Those of an instance, in the order of its triangles.
  [[nodiscard]] const std::vector<Patch>& patches(std::size_t instance) const { return patches_[instance]; }
  [[nodiscard]] int shots() const { return shots_; }

 private:
  [[nodiscard]] Patch* brightest();
  [[nodiscard]] double unshotPower() const;

  const render::EmbreeScene& embree_;
  std::vector<std::vector<Patch>> patches_;
  int shots_ = 0;
};

}  // namespace promenade::tests
