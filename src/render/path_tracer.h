#pragma once
// The light that reaches the eye along one primary ray. Not part of the folder's public face.

#include <cstdint>
#include <optional>

#include "src/render/embree_scene.h"
#include "src/render/environment.h"
#include "src/render/lights.h"
#include "src/render/path_renderer.h"
#include "src/render/sampler.h"
#include "src/render/sky_guide.h"
#include "src/render/surfaces.h"

namespace promenade::render {

class ScatteringSurface;

struct SampleRadiance {
  Rgb diffuse{0.0f};
  Rgb viewDependent{0.0f};
};

/// Counted by whoever calls; one a thread.
struct PathRays {
  std::uint64_t scattered = 0;
  std::uint64_t shadow = 0;
};

class PathTracer {
 public:
  PathTracer(const Scene& scene, const PathSettings& settings);

  [[nodiscard]] const EmbreeScene& embree() const { return embree_; }
  [[nodiscard]] const Surfaces& surfaces() const { return surfaces_; }

  /// What a primary ray that hits nothing sees.
  [[nodiscard]] Rgb background(const glm::vec3& unitDirection) const;
  /// Mean of the paths from a primary hit. `pixelWidth`: of a sample at distance 1 along the view axis, of
  /// which `direction` has component 1.
  [[nodiscard]] SampleRadiance shade(const Hit& hit, const Ray& primary, float pixelWidth,
                                     const Sampler::Stream& stream, PathRays& rays) const;

 private:
  struct Vertex;
  /// The rays that one path stands for, where they meet a surface.
  struct Pencil {
    float width = 0.0f;
    bool blurred = false;  ///< some scattering before was not a mirror's
  };
  struct Carried;
  struct Shares;
  class ShadowBatch;

  [[nodiscard]] Vertex vertexAt(const Hit& hit, const glm::vec3& unitDirection, const Pencil& pencil) const;
  [[nodiscard]] Shares firstShares(const Vertex& vertex) const;
  [[nodiscard]] Shares laterShares(const Vertex& vertex) const;
  template <class Add>
  void sampleLights(const Vertex& vertex, const ScatteringSurface& scattering, const Shares& shares,
                    Sampler& sampler, const Add& add) const;
  [[nodiscard]] Rgb follow(Carried carried, Sampler& sampler, PathRays& rays) const;

  PathSettings settings_;
  Surfaces surfaces_;
  EmbreeScene embree_;
  std::optional<EnvironmentLight> environment_;
  std::optional<SkyGuide> sky_;
  Lights lights_;
};

}  // namespace promenade::render
